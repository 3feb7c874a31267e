// Simbody as an engine of furiko: forward dynamics of planar trees, over furiko's engine protocol.
//
//   ./build.sh && furiko check -e ./furiko-simbody
//   ./furiko-simbody-maximal: the same with free planar bodies held together by constraints
//
// Messages come on standard input and answers go to standard output; docs/reference/engine-protocol.md says how. Each
// link is a body on a Pin about Simbody's z, in the plane x-y with gravity along -y: angles keep their sign. Its
// coordinates are relative to the parent's. In the maximal formulation each link is a MobilizedBody::Planar on the
// ground, in absolute angles, and two equations (Constraint::PointInPlane) hold each hinge together.

#include <Simbody.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace SimTK;

// ---- frames: "furiko", 1, newline; length (8 bytes) and CRC-32 (4), highest byte first; the content ----

static uint32_t crc(const std::string& bytes) {
    uint32_t value = 0xFFFFFFFFu;
    for (unsigned char byte : bytes) {
        value ^= byte;
        for (int bit = 0; bit < 8; bit++) value = (value >> 1) ^ (0xEDB88320u & -(value & 1));
    }
    return ~value;
}

static uint64_t number(const char* bytes, int size) {
    uint64_t value = 0;
    for (int i = 0; i < size; i++) value = value << 8 | (unsigned char)bytes[i];
    return value;
}

static std::string digits(uint64_t value, int size) {
    std::string bytes(size, 0);
    for (int i = size - 1; i >= 0; i--, value >>= 8) bytes[i] = (char)value;
    return bytes;
}

static bool receive(std::string& content) {
    char head[20];
    if (fread(head, 1, 20, stdin) != 20 || memcmp(head, "furiko\1\n", 8)) return false;
    uint64_t size = number(head + 8, 8);
    if (size > (1u << 28)) return false;
    content.resize(size);
    return fread(&content[0], 1, size, stdin) == size && crc(content) == number(head + 16, 4);
}

static void answer(const std::string& text, const std::vector<double>& numbers = {}) {
    std::string content = digits(text.size(), 4) + text;
    content.append((const char*)numbers.data(), 8 * numbers.size());
    std::string frame = std::string("furiko\1\n", 8) + digits(content.size(), 8) + digits(crc(content), 4) + content;
    fwrite(frame.data(), 1, frame.size(), stdout);
    fflush(stdout);
}

// ---- the mechanism, from furiko's own text: looking for a key in it is enough ----

struct Link {
    int parent;
    double hinge[2], com[2], mass, inertia;
};

static double value(const char*& text, const char* key) {
    const char* found = strstr(text, key);
    if (!found) throw std::runtime_error(std::string("no ") + key);
    found += strlen(key);
    while (*found && strchr(" :[", *found)) found++;
    char* end;
    double number = strtod(found, &end);
    text = end;
    return number;
}

static std::vector<Link> links_of(const std::string& text) {
    std::vector<Link> links;
    const char* at = strstr(text.c_str(), "\"links\"");
    while (at && strstr(at, "\"parent\"")) {
        Link link;
        link.parent = (int)value(at, "\"parent\"");
        link.hinge[0] = value(at, "\"hinge\""), link.hinge[1] = value(at, ",");
        link.com[0] = value(at, "\"com\""), link.com[1] = value(at, ",");
        link.mass = value(at, "\"mass\""), link.inertia = value(at, "\"inertia\"");
        links.push_back(link);
    }
    return links;
}

// (along, across) of a link that hangs at angle zero, in the plane x-y with y up.
static Vec3 place(const double point[2]) { return Vec3(point[1], -point[0], 0); }

class Model {
public:
    Model(const std::vector<Link>& given, double weight, bool maximal)
        : links(given), maximal(maximal), matter(system), forces(system),
          gravity(forces, matter, UnitVec3(0, -1, 0), weight) {
        for (size_t i = 0; i < links.size(); i++) {
            const Link& link = links[i];
            Vec3 com = place(link.com);
            // The inertia of MassProperties is about the body's origin, which is the hinge.
            Inertia about_hinge = Inertia(link.inertia, link.inertia, link.inertia).shiftFromMassCenter(com, link.mass);
            Body::Rigid body(MassProperties(link.mass, com, about_hinge));
            if (maximal) {
                bodies.push_back(MobilizedBody::Planar(matter.Ground(), Transform(), body, Transform()));
                MobilizedBody& on = link.parent < 0 ? matter.updGround() : bodies[link.parent];
                // Two equations: the hinge's place on the parent is where the link's origin is, in x and in y.
                Constraint::PointInPlane(on, UnitVec3(1, 0, 0), place(link.hinge)[0], bodies[i], Vec3(0));
                Constraint::PointInPlane(on, UnitVec3(0, 1, 0), place(link.hinge)[1], bodies[i], Vec3(0));
            } else {
                MobilizedBody& on = link.parent < 0 ? matter.updGround() : bodies[link.parent];
                bodies.push_back(MobilizedBody::Pin(on, Transform(place(link.hinge)), body, Transform()));
            }
        }
        state = system.realizeTopology();
        system.realizeModel(state);
    }

    size_t n() const { return links.size(); }

    void accelerations(const double* theta, const double* omega, double* alpha) {
        set(theta, omega);
        system.realize(state, Stage::Acceleration);
        for (size_t i = 0; i < n(); i++) {
            alpha[i] = bodies[i].getOneUDot(state, 0);
            if (!maximal && links[i].parent >= 0) alpha[i] += alpha[links[i].parent];
        }
    }

    // M^-1 of absolute angles: S X S', a column the accelerations of a unit force on one absolute angle.
    void inverse_mass(const double* theta, double* found) {
        std::vector<double> rest(n(), 0);
        set(theta, rest.data());
        system.realize(state, Stage::Position);
        for (size_t k = 0; k < n(); k++) {
            Vector force(state.getNU(), Real(0)), turned;
            force[bodies[k].getFirstUIndex(state)] = 1;
            for (int j = (int)k; links[j].parent >= 0; j = links[j].parent) // S' e_k is one on all of the path
                force[bodies[links[j].parent].getFirstUIndex(state)] = 1;
            matter.multiplyByMInv(state, force, turned);
            for (size_t i = 0; i < n(); i++) {
                double above = links[i].parent >= 0 ? found[links[i].parent * n() + k] : 0;
                found[i * n() + k] = turned[bodies[i].getFirstUIndex(state)] + above;
            }
        }
    }

    void energy(const double* theta, const double* omega, double* both) {
        set(theta, omega);
        system.realize(state, Stage::Velocity);
        both[0] = system.calcKineticEnergy(state), both[1] = system.calcPotentialEnergy(state);
    }

private:
    void set(const double* theta, const double* omega) {
        std::vector<Vec3> at(n()), speed(n());
        for (size_t i = 0; i < n(); i++) {
            int parent = links[i].parent;
            if (!maximal) {
                bodies[i].setOneQ(state, 0, theta[i] - (parent < 0 ? 0 : theta[parent]));
                bodies[i].setOneU(state, 0, omega[i] - (parent < 0 ? 0 : omega[parent]));
                continue;
            }
            Vec3 arm = place(links[i].hinge), moved(0);
            at[i] = arm, speed[i] = Vec3(0);
            if (parent >= 0) {
                double c = cos(theta[parent]), s = sin(theta[parent]);
                moved = Vec3(c * arm[0] - s * arm[1], s * arm[0] + c * arm[1], 0);
                at[i] = at[parent] + moved;
                speed[i] = speed[parent] + omega[parent] * Vec3(-moved[1], moved[0], 0);
            }
            bodies[i].setOneQ(state, 0, theta[i]), bodies[i].setOneU(state, 0, omega[i]);
            for (int axis = 0; axis < 2; axis++) {
                bodies[i].setOneQ(state, 1 + axis, at[i][axis]);
                bodies[i].setOneU(state, 1 + axis, speed[i][axis]);
            }
        }
    }

    std::vector<Link> links;
    bool maximal;
    MultibodySystem system;
    SimbodyMatterSubsystem matter;
    GeneralForceSubsystem forces;
    Force::Gravity gravity;
    std::vector<MobilizedBody> bodies;
    State state;
};

// ---- what is asked ----

static std::map<int, std::unique_ptr<Model>> models;

static bool says(const std::string& text, const char* what) { return text.find(what) != std::string::npos; }

static std::string shaped(const char* name, size_t states, const std::string& rest) {
    return std::string("{\"say\": \"answer\", \"arrays\": [[\"") + name + "\", [" + std::to_string(states) + rest + "]]]}";
}

static void hello(bool maximal) {
    int major, minor, build;
    SimTK_version_simbody(&major, &minor, &build);
    std::string version = std::to_string(major) + "." + std::to_string(minor);
    std::string common = "{\"say\": \"hello\", \"protocol\": 1, \"version\": \"" + version + "\", ";
    if (maximal)
        answer(common +
               "\"questions\": [\"accelerations\", \"energy\"], \"coordinates\": \"maximal\", \"ordering\": \"bodies\", \"largest_n\": 100, "
               "\"largest_n_reason\": \"longer chains were not tried\", "
               "\"no_point_masses\": \"a free body without an inertia of its own has a singular mass matrix\", "
               "\"formulation\": \"free planar bodies, two constraints a hinge, Lagrange multipliers; in C++\"}");
    else
        answer(common +
               "\"questions\": [\"accelerations\", \"inverse_mass\", \"energy\"], \"coordinates\": \"relative\", "
               "\"missing\": {\"derivatives\": \"Simbody differentiates no accelerations\"}, \"largest_n\": 200, "
               "\"largest_n_reason\": \"longer chains were not tried\", "
               "\"formulation\": \"articulated bodies on pins, in O(n); in C++\"}");
}

static void ask(const std::string& text, const char* arrays, size_t size) {
    const char* at = text.c_str();
    Model& model = *models.at((int)value(at, "\"model\""));
    size_t n = model.n();
    std::vector<double> given(size / 8), found;
    memcpy(given.data(), arrays, size);
    if (says(text, "\"question\": \"inverse_mass\"")) {
        size_t states = given.size() / n;
        found.resize(states * n * n);
        for (size_t b = 0; b < states; b++) model.inverse_mass(&given[b * n], &found[b * n * n]);
        answer(shaped("inverse_mass", states, ", " + std::to_string(n) + ", " + std::to_string(n)), found);
        return;
    }
    size_t states = given.size() / (2 * n), width = says(text, "\"question\": \"energy\"") ? 2 : n;
    found.resize(states * width);
    for (size_t b = 0; b < states; b++) {
        const double *theta = &given[b * n], *omega = &given[(states + b) * n];
        if (width == 2 && says(text, "\"question\": \"energy\"")) model.energy(theta, omega, &found[b * width]);
        else model.accelerations(theta, omega, &found[b * width]);
    }
    const char* name = says(text, "\"question\": \"energy\"") ? "energy" : "accelerations";
    answer(shaped(name, states, ", " + std::to_string(width)), found);
}

static std::string plain(const std::string& words) {
    std::string kept;
    for (char c : words) kept += c == '"' || c == '\\' ? '\'' : (unsigned char)c < 32 ? ' ' : c;
    return kept;
}

static void respond(const std::string& text, const char* arrays, size_t size, bool maximal) {
    const char* at = text.c_str();
    if (says(text, "\"say\": \"hello\"")) return hello(maximal);
    if (says(text, "\"say\": \"drop\"")) {
        models.erase((int)value(at, "\"model\""));
        return answer("{\"say\": \"dropped\"}");
    }
    if (!says(text, "\"say\": \"build\"")) return ask(text, arrays, size);
    int key = (int)value(at, "\"model\"");
    at = text.c_str();
    double weight = value(at, "\"gravity\"");
    std::vector<Link> links = links_of(text);
    for (const Link& link : links)
        if (maximal && !(link.inertia > 0)) // a planar body without inertia is singular, and Simbody would not say so
            return answer("{\"say\": \"error\", \"kind\": \"invalid\", \"what\": \"free bodies need an inertia about "
                          "their own centre: point masses have none\"}");
    models[key].reset(new Model(links, weight, maximal));
    answer("{\"say\": \"built\"}");
}

int main(int, char** arguments) {
    bool maximal = strstr(arguments[0], "maximal") != nullptr;
    for (std::string content; receive(content);) {
        uint64_t length = content.size() < 4 ? 0 : number(content.data(), 4);
        if (content.size() < 4 || length > content.size() - 4) return 1;
        std::string text = content.substr(4, length);
        try {
            respond(text, content.data() + 4 + length, content.size() - 4 - length, maximal);
        } catch (const std::exception& error) {
            answer("{\"say\": \"error\", \"kind\": \"failed\", \"what\": \"" + plain(error.what()) + "\"}");
        }
    }
    return 0;
}
