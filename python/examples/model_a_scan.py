#!/usr/bin/env python3
"""Models a scan, a cloud or a depth image, and prints its tubes.

    model_a_scan.py SCAN SCENE.toml

The scene file says what is known of camera, bin and tubes (docs/real-scans.md). The tubes are in its world frame, m.
The same in C++: examples/model_a_scan.
"""

import argparse
import sys

import tanglebin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scan", help="cloud or depth image")
    parser.add_argument("scene", help="scene file (TOML)")
    arguments = parser.parse_args()

    measured = tanglebin.read_measurement(arguments.scan, tanglebin.read_scene(arguments.scene))
    resolved = tanglebin.resolve(measured.scene, measured.cloud)
    for note in resolved.notes:
        print(note, file=sys.stderr)

    model = tanglebin.model_tubes(resolved.cloud, resolved.known)
    for finding in model.findings:
        print(finding.message, file=sys.stderr)
    if model.is_refused:
        return 1
    for tube, evidence in zip(model.tubes, model.evidence):
        print(
            f"tube {tube.id}: radius {tube.radius:.4f} m, length {evidence.length:.3f} m, {evidence.points} points, "
            f"confidence {evidence.confidence:.2f}"
        )
        for line in tube.centre_lines:
            for x, y, z in line:
                print(f"  {x:.4f} {y:.4f} {z:.4f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
