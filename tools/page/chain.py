#!/usr/bin/env python3
"""A scene of so many free bodies one behind the other, bent in a gentle wave that goes on: `python3 chain.py BODIES`."""

import math
import sys

count = int(sys.argv[1])
print(f'title = "a chain of {count} ellipsoids"\nfluid.density = 1000\nstart.velocity = "zero-momentum"\n')
for i in range(count):
    wave = 2 * math.pi * i / 20
    angle, rate = 0.35 * math.sin(wave), 0.1 * math.cos(wave)
    out = 0.03 * math.cos(wave / 3)
    turn = f"{'angular_velocity' if i == 0 else 'joint_rate'} = [0, {out:.4f}, {rate:.4f}]"
    attitude = f"attitude = {{ axis = [0, 0, 1], angle = {angle:.4f} }}"
    print(f'[[body]]\nname = "{i}"\nsemi_axes = [0.1, 0.045, 0.06]\n{attitude}\n{turn}\n')
for i in range(1, count):
    print(f'[[joint]]\nparent = "{i - 1}"\nchild = "{i}"\nat_parent = [-0.1025, 0, 0]\nat_child = [0.1025, 0, 0]\n')
