"""Small model files with joints of every kind, by hand, that MuJoCo and Pinocchio read alike."""

INERTIAL = '<inertial pos="0.05 0.1 -0.2" mass="{}" fullinertia="0.11 0.2 0.25 0.02 -0.01 0.03"/>'
# Each joint kind in one file that both engines read alike. Joints and bodies without names too.
ALIKE = {
    "free": f"""<body name="a" pos="0.3 -0.2 0.5"><joint name="j" type="free"/>{INERTIAL.format(1.5)}</body>""",
    "free, tilted, unnamed": f"""<body pos="0 0 0.5" quat="0.8 0.6 0 0"><freejoint/>{INERTIAL.format(1.5)}
        <body pos="0.1 0 0.2"><joint type="hinge" axis="1 2 0" pos="0 0.1 0"/>{INERTIAL.format(0.7)}</body></body>""",
    "ball": f"""<body name="a" pos="0.1 0 0" quat="0.9 0.1 0.2 -0.3">
        <joint name="j" type="ball" pos="0 0.2 0.1" armature="0.05"/>{INERTIAL.format(1.5)}
        <body name="b" pos="0 0.3 0"><joint name="k" type="ball"/>{INERTIAL.format(1)}</body></body>""",
    "slide": f"""<body name="a"><joint name="j" type="slide" axis="1 1 0" armature="0.3"/>{INERTIAL.format(1.5)}
        <body name="b" pos="0 0.3 0"><joint name="k" axis="0 1 1" pos="0.1 0 0" armature="0.1" damping="0.4"/>
        {INERTIAL.format(1)}</body></body>""",
    "several joints a body": f"""<body name="a" pos="0 0.1 0" euler="0.3 0 0.2">
        <joint name="x" type="slide" axis="1 0 0" armature="0.2"/><joint name="y" axis="0 1 0" pos="0.1 0 0.2"/>
        <joint name="z" axis="0 1 1" pos="0 0.3 0" armature="0.1"/>{INERTIAL.format(1.5)}
        <body pos="0 0 0.3"><joint axis="1 0 0"/><joint type="ball" pos="0 0.3 0.2"/>
        {INERTIAL.format(1)}<body pos="0.1 0 0"><joint name="u" axis="1 0 0"/><joint name="w" axis="0 1 0"/>
        {INERTIAL.format(1)}</body></body></body>""",
    "ref": f"""<body name="a" pos="0 0.1 0"><joint name="x" axis="0 1 1" ref="0.4" pos="0.1 0 0"/>{INERTIAL.format(1.5)}
        <body name="b" pos="0 0 0.3"><joint name="y" axis="1 0 0"/>
        <joint name="z" axis="0 1 0" ref="-0.3" pos="0 0.1 0"/>
        <joint name="s" type="slide" axis="0 1 2" ref="0.2"/>{INERTIAL.format(1)}</body></body>""",
    "branches": f"""<body name="a"><joint name="j10" axis="0 1 0"/>{INERTIAL.format(1.5)}
        <body name="c" pos="0 0 0.3"><joint name="j2" axis="1 0 0"/>{INERTIAL.format(1)}
        <body name="fixed" pos="0.2 0 0" euler="0 0.4 0">{INERTIAL.format(0.4)}</body></body>
        <body name="b" pos="0.2 0 0"><joint name="j1" axis="0 0 1"/>{INERTIAL.format(2)}</body></body>""",
}
LINK = """<link name="{}"><inertial><origin xyz="0.05 0.1 -0.2" rpy="0.3 -0.2 0.1"/><mass value="{}"/>
    <inertia ixx="0.11" iyy="0.2" izz="0.25" ixy="0.02" ixz="-0.01" iyz="0.03"/></inertial></link>"""


def urdf_joint(kind, name, parent, child, axis="0 0 1", xyz="0.1 0.2 0.3", rpy="0.3 -0.4 0.5"):
    limit = '<limit lower="-2" upper="2" effort="1" velocity="1"/>' if kind in {"revolute", "prismatic"} else ""
    return f"""<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
        <origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>{limit}</joint>"""


URDFS = {
    "floating with an origin": [LINK.format("a", 2), LINK.format("b", 1), urdf_joint("floating", "j", "world", "a"),
                                urdf_joint("continuous", "k", "a", "b", "0 0.6 0.8")],
    "planar": [LINK.format("a", 2), LINK.format("b", 1), urdf_joint("planar", "j", "world", "a"),
               urdf_joint("revolute", "k", "a", "b", "0 1 0")],
    "continuous and prismatic, order by name": [
        LINK.format("a", 2), LINK.format("b", 1), LINK.format("c", 1),
        urdf_joint("continuous", "z", "world", "a", "1 0 0"), urdf_joint("prismatic", "k", "a", "b", "0.6 0 0.8"),
        urdf_joint("continuous", "h", "a", "c", "0 1 0")],
}  # fmt: skip


def mjcf(body, options="", more=""):
    return (
        f"""<mujoco><compiler angle="radian" autolimits="true"/>{options}<worldbody>{body}</worldbody>{more}</mujoco>"""
    )


def urdf(parts):
    return f"""<robot name="r"><link name="world"/>{"".join(parts)}</robot>"""
