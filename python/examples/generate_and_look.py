#!/usr/bin/env python3
"""Draws a tangle, scans it and shows the labelled cloud and the true tubes with Open3D.

    generate_and_look.py [RECIPE] [--tubes N] [--out cloud.ply]

Without a recipe, the tubes are the paper's. With --out, Open3D writes the cloud to a file, and no window opens.
World frame: z up, origin at the centre of the bin's floor; metres.
"""

import argparse

import open3d
import tanglebin

PAPER = """
seed = 1
[[set]]
name = "A"
tubes = [1, 5, 10, 20]
[set.tube]
radius = 0.0125
mass = 0.5
length = 0.5
cylinders_min = 5
cylinders_max = 10
cylinder_length_min = 0.02
bend_min_deg = 0
bend_max_deg = 30
"""


def open3d_cloud(cloud):
    shown = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(cloud.points))
    shown.colors = open3d.utility.Vector3dVector(cloud.colors / 255)
    return shown


def open3d_mesh(tube):
    mesh = tanglebin.mesh_of(tube)
    shown = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(mesh.vertices), open3d.utility.Vector3iVector(mesh.triangles.astype("int32"))
    )
    shown.compute_vertex_normals()
    return shown


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recipe", nargs="?", help="recipe (TOML)")
    parser.add_argument("--tubes", type=int, default=5, help="how many, of those that the recipe has")
    parser.add_argument("--out", help="write the cloud to this file (PLY, PCD) and open no window")
    arguments = parser.parse_args()

    recipe = tanglebin.read_recipe(arguments.recipe) if arguments.recipe else tanglebin.Recipe(PAPER)
    case = tanglebin.CaseId(recipe.sets[0].name, arguments.tubes, 1)
    scene = tanglebin.simulate(recipe, case)
    cloud = tanglebin.cloud_from_scan(scene.scan, tubes=arguments.tubes, with_bin=True)
    print(f"{len(cloud)} points on {len(scene.tubes)} tubes and the bin")

    if arguments.out:
        open3d.io.write_point_cloud(arguments.out, open3d_cloud(cloud))
    else:
        open3d.visualization.draw_geometries([open3d_cloud(cloud)] + [open3d_mesh(tube) for tube in scene.tubes])


if __name__ == "__main__":
    main()
