#!/usr/bin/env python3
"""A scene with many bodies: a feather star, whose arms beat in a travelling wave. `python3 star.py [ARMS LINKS]`; 13 arms of 23 are 300 bodies."""

import math
import sys

arms, links = (int(n) for n in sys.argv[1:3]) if len(sys.argv) > 2 else (13, 23)
print('title = "a feather star of %d bodies"' % (1 + arms * links))
print("fluid.density = 1000\nstart.momentum = \"zero\"\n")
print('[[body]]\nname = "hub"\nsemi_axes = [0.22, 0.22, 0.12]\n')
for arm in range(arms):
    for link in range(links):
        size = 1 - 0.6 * link / links
        print(f'[[body]]\nname = "{arm}-{link}"\nsemi_axes = [0.07, {0.03 * size:.4f}, {0.045 * size:.4f}]\n')
for arm in range(arms):
    angle = 2 * math.pi * arm / arms
    for link in range(links):
        first = link == 0
        parent = "hub" if first else f"{arm}-{link - 1}"
        at = [0.25 * math.cos(angle), 0.25 * math.sin(angle), 0.0] if first else [0.075, 0, 0]
        rest = f'rest = {{ axis = [0, 0, 1], angle = {angle:.6f} }}\n' if first else ""
        print(f'[[joint]]\nparent = "{parent}"\nchild = "{arm}-{link}"\nat_parent = {at}\nat_child = [-0.075, 0, 0]\ntype = "hinge"\naxis = [0, 1, 0]\n{rest}')
    joints = ", ".join(f'"{arm}-{link}"' for link in range(links))
    print(f"[[gait]]\njoints = [{joints}]\namplitude = 0.16\nfrequency = 0.25\nphase_lag = 0.28\nramp = 1\n")
