#!/bin/sh
# Builds Simbody's adapters as two programs in the folder given, or here; Simbody is Debian's libsimbody-dev.
#   apt-get install g++ libsimbody-dev && ./build.sh && furiko check -e ./furiko-simbody
set -eu
here=$(cd "$(dirname "$0")" && pwd)
into=${1:-.}
if ! echo '#include <Simbody.h>' | ${CXX:-c++} -std=c++17 -isystem /usr/include/simbody -E -x c++ - > /dev/null 2>&1; then
    echo "build.sh: a C++ compiler and Simbody are needed: apt-get install g++ libsimbody-dev" >&2
    exit 1
fi
${CXX:-c++} -std=c++17 -O2 -isystem /usr/include/simbody "$here/furiko_simbody.cpp" -o "$into/furiko-simbody" \
    -lSimTKsimbody -lSimTKmath -lSimTKcommon
ln -sf furiko-simbody "$into/furiko-simbody-maximal"
echo "$into/furiko-simbody, $into/furiko-simbody-maximal"
