"""A mechanism in space built in MuJoCo and in Pinocchio by their own interfaces: engines that are right.

Each gives M, bias, passive forces (MuJoCo) and accelerations in MuJoCo's coordinates.
"""

from dataclasses import replace

import numpy as np

from furiko.reference.spatial_kinematics import rotations


def unit_quaternions(mechanism, q):
    """The state with its quaternions in unit length, which engines expect."""
    q = q.copy()
    for one in mechanism.joints:
        if one.joint.coordinates >= 4:
            q[one.columns_q][-4:] /= np.linalg.norm(q[one.columns_q][-4:])
    return q


def without_free_armature(mechanism):
    """The same, but that free joints have none: Pinocchio has a translation's in axes that turn with the body."""
    bodies = [
        replace(body, joints=tuple(replace(j, armature=0.0) if j.kind == "free" else j for j in body.joints))
        for body in mechanism.bodies
    ]
    return replace(mechanism, bodies=tuple(bodies))


class MuJoCo:
    """Bodies must be in depth-first order."""

    def __init__(self, mechanism):
        import mujoco

        spec = mujoco.MjSpec()
        spec.compiler.degree = False
        spec.option.gravity = mechanism.gravity
        spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        bodies = []
        for body in mechanism.bodies:
            parent = spec.worldbody if body.parent < 0 else bodies[body.parent]
            tensor = body.inertial.tensor
            made = parent.add_body(
                name=body.name,
                pos=body.position,
                quat=body.quaternion,
                mass=body.inertial.mass,
                ipos=body.inertial.centre,
                fullinertia=[tensor[i, k] for i, k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))],
                explicitinertial=True,
            )
            for joint in body.joints:
                kind = getattr(mujoco.mjtJoint, f"mjJNT_{joint.kind.upper()}")
                own = made.add_joint(name=joint.name, type=kind, axis=joint.axis, pos=joint.anchor)
                own.ref, own.springref, own.armature = joint.ref, joint.springref, joint.armature
                for name in ("damping", "stiffness"):  # the first coefficient, where they are polynomials
                    given = getattr(own, name)
                    value = getattr(joint, name)
                    setattr(own, name, value if np.ndim(given) == 0 else [value] + [0.0] * (len(given) - 1))
            bodies.append(made)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)

    def terms(self, q, v, torque):
        import mujoco

        self.data.qpos, self.data.qvel, self.data.qfrc_applied = q, v, torque
        mujoco.mj_forward(self.model, self.data)
        mass = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, self.data, mass)
        return mass, self.data.qfrc_bias.copy(), self.data.qfrc_passive.copy(), self.data.qacc_smooth.copy()


class Pinocchio:
    """Forward dynamics by the articulated-body algorithm; it knows no springs or dampers, which are added as forces."""

    def __init__(self, mechanism):
        import pinocchio as pin

        self.mechanism = mechanism
        self.model = pin.Model()
        self.model.gravity.linear = mechanism.gravity
        made = []  # of each body: its joint in the model and its pose there
        for body in mechanism.bodies:
            joint_id, pose = made[body.parent] if body.parent >= 0 else (0, pin.SE3.Identity())
            pose = pose * pin.SE3(rotations(body.quaternion[None])[0], body.position)
            for joint in body.joints:
                at, kind, back = self._joint(pin, joint)
                pose = pin.SE3.Identity() if joint.kind == "free" else pose * at
                joint_id = self.model.addJoint(joint_id, kind, pose, joint.name)
                pose = back
            inertial = body.inertial
            self.model.appendBodyToJoint(joint_id, pin.Inertia(inertial.mass, inertial.centre, inertial.tensor), pose)
            made.append((joint_id, pose))
        self.model.armature = mechanism.per_freedom("armature")
        self.data = self.model.createData()

    @staticmethod
    def _joint(pin, joint):
        axis = joint.axis / np.linalg.norm(joint.axis)
        if joint.kind == "slide":
            return pin.SE3.Identity(), pin.JointModelPrismaticUnaligned(axis), pin.SE3(np.eye(3), -joint.ref * axis)
        if joint.kind == "free":
            return pin.SE3.Identity(), pin.JointModelFreeFlyer(), pin.SE3.Identity()
        there, back = pin.SE3(np.eye(3), joint.anchor), pin.SE3(np.eye(3), -joint.anchor)
        if joint.kind == "ball":
            return there, pin.JointModelSpherical(), back
        turned = rotations(np.array([[np.cos(joint.ref / 2), *(-np.sin(joint.ref / 2) * axis)]]))[0]
        return there, pin.JointModelRevoluteUnaligned(axis), pin.SE3(turned, np.zeros(3)) * back

    def terms(self, q, v, torque, passive):
        """``passive`` (nv,): what is added to ``torque`` in forward dynamics."""
        import pinocchio as pin

        own, free = q.copy(), None
        for one in self.mechanism.joints:
            if one.joint.coordinates >= 4:
                part = own[one.columns_q][-4:]
                part[:] = np.roll(part, -1)
            if one.joint.kind == "free":
                free = one
        turn = np.eye(self.mechanism.nv)  # own rates from MuJoCo's
        swing = np.zeros(self.mechanism.nv)  # what own accelerations have besides
        if free is not None:
            rotation = rotations(q[free.columns_q][None, 3:])[0]
            first = slice(free.at_v, free.at_v + 3)
            turn[first, first] = rotation.T
            swing[first] = -np.cross(v[free.columns_v][3:], rotation.T @ v[first])
        rates = turn @ v
        mass = np.asarray(pin.crba(self.model, self.data, own))
        mass = np.triu(mass) + np.triu(mass, 1).T
        bias = pin.rnea(self.model, self.data, own, rates, np.zeros_like(v)) + mass @ swing
        found = pin.aba(self.model, self.data, own, rates, turn @ (torque + passive))
        return turn.T @ mass @ turn, turn.T @ bias, None, turn.T @ (found - swing)
