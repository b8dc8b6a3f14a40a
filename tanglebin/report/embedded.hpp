#pragma once

#include <string_view>

// Files that pages are made of. The build puts their bytes into the program (tanglebin/CMakeLists.txt).
namespace tanglebin::embedded {

extern const std::string_view paper_toml;  ///< the paper's recipes
extern const std::string_view set_a_toml;
extern const std::string_view set_b_toml;
extern const std::string_view three_js;           ///< three.js, 3D in browsers
extern const std::string_view orbit_controls_js;  ///< of three.js: turns a view by mouse and finger
extern const std::string_view chart_js;           ///< Chart.js, plots
extern const std::string_view licences_txt;       ///< of the libraries
extern const std::string_view runs_js;            ///< all runs, to sort, filter and plot
extern const std::string_view runs_css;
extern const std::string_view scene_view_js;  ///< shows scenes (scene_view.hpp)
extern const std::string_view scene_view_css;

}  // namespace tanglebin::embedded
