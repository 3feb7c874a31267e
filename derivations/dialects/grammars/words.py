# ruff: noqa: E501 -- tables stand on one line; one branch for each kind
"""What the libraries of these languages call what the follower knows."""

from __future__ import annotations

import re

MODULES = frozenset((
    "Math", "MathF", "Mathf", "math", "std", "cmath", "glm", "libm", "f64", "f32", "kotlin", "numeric", "mathjs", "arma",
    "Base", "LinearAlgebra", "THREE", "Eigen", "nalgebra", "na", "consts", "numbers",
))  # fmt: skip
CALLED = {
    "fabs": "abs", "fabsf": "abs", "sq": "square", "sqr": "square", "SQR": "square", "Square": "square",
    "powi": "pow", "powf": "pow", "gsl_pow_int": "pow", "sin_cos": "sincos", "SinCos": "sincos", "Sincos": "sincos",
    "lusolve": "solve", "Solve": "solve", "linsolve": "solve", "try_inverse": "inv", "Inverse": "inv", "inverse": "inv",
    "Transpose": "transpose", "sincosf": "sincos", "LUsolve": "solve", "gsl_pow_2": "square", "pow2": "square",
    "Max": "max", "Min": "min", "imax": "max", "imin": "min", "fmax": "max", "fmin": "min", "Sqrt": "sqrt",
    "Abs": "abs", "Sign": "sign", "Determinant": "det", "determinant": "det",
}  # fmt: skip
WAVES = re.compile(r"(?P<f>sin|cos|tan|sqrt|pow|abs)[fl]?", re.IGNORECASE)
DEGREES = re.compile(r"(?:radians|degrees|toRadians|toDegrees|deg2rad)", re.IGNORECASE)
SAME = frozenset((  # of what stands in front
    "lu", "ldlt", "llt", "qr", "partialPivLu", "fullPivLu", "colPivHouseholderQr", "householderQr", "getSolver", "unwrap",
    "expect", "iter", "into_iter", "clone", "to_owned", "to_vec", "eval", "as_slice", "copy", "toArray", "ToArray", "flat",
    "copied", "cloned", "as_ref", "into", "slice_copy", "completeOrthogonalDecomposition", "jacobiSvd", "cholesky",
    "col_piv_qr", "matrix", "array", "collect", "asList", "toList", "values", "valueOf", "Clone", "toDoubleArray",
    "as_mut", "iter_mut", "data", "finished", "asDiagonalless",
))  # fmt: skip
CASTS = frozenset((
    "double", "float", "Number", "parseFloat", "f64", "float64", "float32", "Float64", "Float32", "toDouble", "toFloat",
    "Double", "Float", "real", "REAL", "Scalar", "realtype", "T",
))  # fmt: skip
LISTS = re.compile(
    r"(?:Eigen)?(?:[SMRC]?[Vv]ector[2-9]?[dfX]?|[Vv]ec[2-9]?[df]?|dvec[2-4]|SVector|SA|Array|List|listOf|arrayOf|mutableListOf"
    r"|doubleArrayOf|floatArrayOf|State|make_tuple|tuple|Tuple|tie|make_array|PVector|createVector|StaticArray|asList"
    r"|state_type|MVector|valarray|array|ArrayRealVector|Ok|Some|Vector\d?d?|DVector|Float64Array|DenseVector|arr1|CreateVector)"
)
MATRICES = re.compile(r"(?:[Mm]atrix[2-4X]?[df]?|[Mm]at[2-4]|SMatrix|DMatrix|Array2DRowRealMatrix|arr2|DenseMatrix)")
EMPTY = re.compile(
    r"(?:zeros|zeros_row|zero|Zero|Zeros|DoubleArray|FloatArray|Float64Array|Float32Array|similar|createZeros)"
)
DATA = frozenset(("N_VGetArrayPointer", "NV_DATA_S", "NV_DATA", "N_VGetArrayPointerConst", "begin"))
ITH = {"NV_Ith_S": 0, "NV_Ith": 0, "Ith": 1}
SOLVERS = re.compile(r"\w*(?:LU|Lu|QR|Cholesky)Decomposition")
CHANGES = re.compile(
    r"set|update|apply|step|integrate|clamp|constrain|wrap|limit|fill|move|scale|mult|normal|rk4|euler|solve",
    re.IGNORECASE,
)
HARMLESS = re.compile(
    r"resize|reserve|clear|log|println?|Println|Printf|printf|draw\w*|line|ellipse|circle|stroke\w*|fill|noStroke|translate|"
    r"background|push\w*|pop\w*|text|rect|rotate|save|restore|beginPath|moveTo|lineTo|arc|stroke|closePath|size|"
    r"WriteLine|Write|assert\w*|debug_assert\w*|UNUSED|max_iterations|super|requestAnimationFrame|noLoop|setup|point|"
    r"strokeWeight|display|show|render|console|delay|Serial"
)
NUMBER = re.compile(r"(?P<n>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)(?P<suffix>[a-zA-Z0-9]*)")


def plain_call(name: str) -> str:
    """The follower's name of a function."""
    if name in CALLED:
        return CALLED[name]
    found = WAVES.fullmatch(name)
    return found["f"].lower() if found else name
