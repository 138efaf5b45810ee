#!/usr/bin/env python3
"""Accelerations of a robot by lgvi and by Pinocchio, from the same URDF, at random states in a vacuum under gravity.

    cargo run --release -p lgvi-urdf --example accelerations -- robot.urdf free > states.json
    python3 tools/urdf/compare.py robot.urdf free states.json        # pip install pin

The base is free or held by the world, in both. Exits with 1 where they differ by more than 1e-10 of the largest acceleration of a state.
"""

import json
import sys

import numpy as np
import pinocchio as pin

TOLERANCE = 1e-10


def main(urdf, base, states):
    free = base == "free"
    model = pin.buildModelFromUrdf(urdf, pin.JointModelFreeFlyer()) if free else pin.buildModelFromUrdf(urdf)
    data = model.createData()
    with open(states) as file:
        run = json.load(file)
    joints = [model.joints[model.getJointId(name)] for name in run["joints"]]
    assert model.nv == len(joints) + 6 * free, f"{model.nv} degrees of freedom, {len(joints)} hinges"
    worst = max(difference(model, data, joints, run, state, free) for state in run["states"])
    print(f"{urdf}: {len(run['states'])} states, {model.nv} degrees of freedom, largest difference {worst:.1e}")
    return worst < TOLERANCE


def difference(model, data, joints, run, state, free):
    q, v, tau = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
    for joint, angle, rate, damping in zip(joints, state["angles"], state["rates"], run["dampings"]):
        q[joint.idx_q : joint.idx_q + joint.nq] = angle if joint.nq == 1 else [np.cos(angle), np.sin(angle)]
        v[joint.idx_v], tau[joint.idx_v] = rate, -damping * rate
    if free:
        w, x, y, z = state["quaternion"]
        q[3:7] = [x, y, z, w]
        turn = pin.Quaternion(w, x, y, z).matrix()
        centre, omega = np.array(run["centre"]), np.array(state["omega"])
        # That of the link's origin, not of its mass centre; in the link's frame.
        v[:3] = turn.T @ state["velocity"] - np.cross(omega, centre)
        v[3:6] = omega
    a = pin.aba(model, data, q, v, tau)
    theirs = [a[joint.idx_v] for joint in joints]
    if free:
        alpha = a[3:6]
        lever = np.cross(alpha, centre) + np.cross(omega, np.cross(omega, centre))
        theirs = [*alpha, *(turn @ (a[:3] + np.cross(omega, v[:3]) + lever)), *theirs]
    ours, theirs = np.array(state["accelerations"]), np.array(theirs)
    return np.abs(ours - theirs).max() / np.abs(theirs).max()


if __name__ == "__main__":
    sys.exit(0 if main(*sys.argv[1:]) else 1)
