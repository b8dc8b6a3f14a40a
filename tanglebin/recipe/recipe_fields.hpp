#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "tanglebin/files/toml_fields.hpp"
#include "tanglebin/io/toml_camera.hpp"
#include "tanglebin/recipe/recipe.hpp"

// Internal to the room: the keys of a recipe and the members that they set. To read and write a new setting,
// add a line here.
namespace tanglebin {

inline constexpr std::tuple bin_fields{
    Field{"length", &Bin::length}, Field{"width", &Bin::width},       Field{"height", &Bin::height},
    Field{"wall", &Bin::wall},     Field{"friction", &Bin::friction},
};
inline constexpr std::tuple sensor_fields{
    Field{"sigma", &Sensor::sigma},
    Field{"dropout", &Sensor::dropout},
    Field{"edges", &Sensor::edges},
    Field{"footprint", &Sensor::footprint},
    Field{"sub_rays", &Sensor::sub_rays},
    Field{"edge_jump", &Sensor::edge_jump},
    Field{"shadows", &Sensor::shadows},
    Field{"baseline", &Sensor::baseline},
    Field{"working_distance", &Sensor::working_distance},
    Field{"signal", &Sensor::signal},
    Field{"snr", &Sensor::snr},
    Field{"snr_min", &Sensor::snr_min},
    Field{"snr_max", &Sensor::snr_max},
    Field{"albedo_min", &Sensor::albedo_min},
    Field{"albedo_max", &Sensor::albedo_max},
    Field{"gloss_min", &Sensor::gloss_min},
    Field{"gloss_max", &Sensor::gloss_max},
    Field{"shininess", &Sensor::shininess},
    Field{"bin_albedo", &Sensor::bin_albedo},
    Field{"bin_gloss", &Sensor::bin_gloss},
    Field{"disparity_sigma", &Sensor::disparity_sigma},
    Field{"trueness", &Sensor::trueness},
    Field{"trueness_length", &Sensor::trueness_length},
    Field{"kinect_noise", &Sensor::kinect_noise},
};
// Written only where one is on, so that the recipes of earlier versions stay the same byte for byte.
inline constexpr std::tuple image_fields{
    Field{"column_correlation", &Sensor::column_correlation},
    Field{"quantization", &Sensor::quantization},
    Field{"fill", &Sensor::fill},
    Field{"median", &Sensor::median},
};
inline constexpr std::tuple settle_fields{
    Field{"gravity", &SettleSettings::gravity},
    Field{"friction", &SettleSettings::friction},
    Field{"step", &SettleSettings::step},
    Field{"iterations", &SettleSettings::iterations},
    Field{"iterations_max", &SettleSettings::iterations_max},
    Field{"sor", &SettleSettings::sor},
    Field{"erp", &SettleSettings::erp},
    Field{"surface_layer", &SettleSettings::surface_layer},
    Field{"correction_speed", &SettleSettings::correction_speed},
    Field{"calm_speed", &SettleSettings::calm_speed},
    Field{"calm_time", &SettleSettings::calm_time},
    Field{"calm_damping", &SettleSettings::calm_damping},
    Field{"rest_speed", &SettleSettings::rest_speed},
    Field{"rest_time", &SettleSettings::rest_time},
    Field{"proof_time", &SettleSettings::proof_time},
    Field{"proof_motion", &SettleSettings::proof_motion},
    Field{"overlap_max", &SettleSettings::overlap_max},
    Field{"time_limit", &SettleSettings::time_limit},
};
inline constexpr std::tuple cloud_fields{
    Field{"plys", &OutputSettings::plys},
};
inline constexpr std::tuple output_fields{
    Field{"bin_points", &OutputSettings::bin_points},
    Field{"worlds", &OutputSettings::worlds},
    Field{"pcds", &OutputSettings::pcds},
    Field{"depths", &OutputSettings::depths},
    Field{"labels", &OutputSettings::labels},
};
inline constexpr std::tuple occlusion_fields{
    Field{"occlusions", &OutputSettings::occlusions},
};
inline constexpr std::tuple property_fields{
    Field{"normals", &PointProperties::normals},
    Field{"intensities", &PointProperties::intensities},
    Field{"mixed", &PointProperties::mixed},
};
inline constexpr std::tuple tube_fields{
    Field{"radius", &TubeSpec::radius},
};
inline constexpr std::tuple mass_fields{
    Field{"mass", &TubeSpec::mass},
};
inline constexpr std::tuple density_fields{
    Field{"density", &TubeSpec::density},
};
inline constexpr std::tuple segment_end_fields{
    Field{"from", &Segment::from},
    Field{"to", &Segment::to},
};
inline constexpr std::tuple segment_fields{
    Field{"length", &Segment::length},
    Field{"cylinders_min", &SegmentSpec::cylinders_min},
    Field{"cylinders_max", &SegmentSpec::cylinders_max},
    Field{"cylinder_length_min", &SegmentSpec::cylinder_length_min},
    AngleField{"bend_min_deg", &SegmentSpec::bend_min},
    AngleField{"bend_max_deg", &SegmentSpec::bend_max},
};

inline constexpr std::tuple straight_fields{
    Field{"length", &Piece::length},
};
inline constexpr std::tuple arc_fields{
    AngleField{"bend_deg", &Piece::bend},
    Field{"bend_radius", &Piece::bend_radius},
    AngleField{"twist_deg", &Piece::twist},
};

struct EdgesName {
  Edges edges;
  std::string_view name;
};
inline constexpr std::array<EdgesName, 3> edges_names{
    {{Edges::keep, "keep"}, {Edges::drop, "drop"}, {Edges::mix, "mix"}}};

/// The keys of [tube], and of a [set.tube] but for its weight.
inline Keys tube_keys() {
  return all({keys(tube_fields),
              {"ends"},
              keys(mass_fields),
              keys(density_fields),
              keys(segment_fields),
              {"segment", "piece"}});
}

}  // namespace tanglebin
