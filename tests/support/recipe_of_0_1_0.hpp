#pragma once

#include <string>
#include <vector>

#include "tanglebin/recipe/recipe.hpp"

// A recipe, and what version 0.1.0 made of it: the recipe.toml of the dataset, and what it drew for a case.
namespace tanglebin::test {

inline const std::string source_of_0_1_0 = R"(
seed = 5
[bin]
height = { min = 0.15, max = 0.25 }
[[scanner]]
name = "above"
width = 120
height = 75
hfov_deg = { one_of = [60, 70] }
[[scanner]]
name = "beside"
preset = "zivid-one-plus-l"
width = 160
height = 100
baseline = { min = 0.1, max = 0.3 }
position = [0.3, { min = 0.6, max = 1 }, 1.2]
look_at = [0, 0, 0.1]
[[set]]
name = "A"
tubes = [2]
cases = 2
[[set.tube]]
radius = 0.0125
mass = { min = 0.4, max = 0.6 }
length = 0.5
bend_max_deg = 30
[[set.tube]]
radius = 0.008
mass = 0.3
[[set.tube.segment]]
from = 1
to = 2
length = 0.3
bend_max_deg = 20
cylinders_max = { min = 5, max = 8 }
[[set.tube.segment]]
from = 2
to = 3
length = 0.1
bend_max_deg = 20
cylinders_min = 2
cylinders_max = 5
)";

inline const std::string recipe_of_0_1_0 =
    R"(# A resolved recipe: every value is here, presets are spelled out.
seed = 5
attempts = 100

[bin]
length = 0.55
width = 0.37
height = { min = 0.15, max = 0.25 }
wall = 0.02
friction = 100.0

[[scanner]]
hfov_deg = { one_of = [60, 70] }
name = "above"
width = 120
height = 75
position = [0.0, 0.0, 2.0]
rotation_matrix = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]

[[scanner]]
look_at = [0, 0, 0.1]
name = "beside"
width = 160
height = 100
fx = 227.5
fy = 227.5
cx = 79.5
cy = 49.5
position = [0.3, { min = 0.6, max = 1 }, 1.2]
sigma = 0.0
dropout = 0.002
edges = "mix"
footprint = 1.0
sub_rays = 3
edge_jump = 0.005
shadows = true
baseline = { min = 0.1, max = 0.3 }
working_distance = 2.0
signal = true
snr = 2.0
snr_min = 0.15
snr_max = 2.5
albedo_min = 0.35
albedo_max = 0.65
gloss_min = 0.1
gloss_max = 1.0
shininess = 60.0
bin_albedo = 0.4
bin_gloss = 0.05
disparity_sigma = 0.04
trueness = 0.0003
trueness_length = 400.0
kinect_noise = false

[settle]
gravity = 9.8
friction = 1.16
step = 0.002
iterations = 50
iterations_max = 200
sor = 1.3
erp = 0.2
surface_layer = 0.0001
correction_speed = 0.5
calm_speed = 1.0
calm_time = 0.3
calm_damping = 0.03
rest_speed = 0.02
rest_time = 0.05
proof_time = 0.25
proof_motion = 0.001
overlap_max = 0.0003
time_limit = 10.0

[output]
bin_points = true
worlds = true
pcds = false
depths = false
labels = false

[[set]]
name = "A"
tubes = [2]
cases = 2

[[set.tube]]
radius = 0.0125
mass = { min = 0.4, max = 0.6 }
length = 0.5
cylinders_min = 5
cylinders_max = 10
cylinder_length_min = 0.02
bend_min_deg = 0.0
bend_max_deg = 30.0

[[set.tube]]
radius = 0.008
mass = 0.3

[[set.tube.segment]]
from = 1
to = 2
length = 0.3
cylinders_min = 5
cylinders_max = { min = 5, max = 8 }
cylinder_length_min = 0.02
bend_min_deg = 0.0
bend_max_deg = 20.0

[[set.tube.segment]]
from = 2
to = 3
length = 0.1
cylinders_min = 2
cylinders_max = 5
cylinder_length_min = 0.02
bend_min_deg = 0.0
bend_max_deg = 20.0
)";

/// For case 1 of set A with 2 tubes.
inline const std::vector<DrawnNumber> drawn_by_0_1_0{
    {"bin.height", 0.23260364274728332},
    {"scanner[0].hfov_deg", 60.0},
    {"scanner[1].position[1]", 0.6059556956204853},
    {"scanner[1].baseline", 0.2658080594894823},
    {"set[0].tube[0].mass", 0.48908665559750714},
    {"set[0].tube[1].segment[0].cylinders_max", 5.0},
};

}  // namespace tanglebin::test
