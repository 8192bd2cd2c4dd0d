"""Rigid nodes joined at points: statics of trees and spring frames. Arrays in, arrays out, any consistent units.

A load case is a force and a torque on every node, (N, 6, K) for K cases, the torque about the node. The answer is the
force and moment (C, 6, K) that the second node of each joint exerts on the first, the moment about the joint's point.
"""
