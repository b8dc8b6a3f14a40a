# cmake --install: the program, the libraries, their public headers and the package file that find_package(tanglebin) reads.
# What is for C++ is the component `development`, the program `program`; packaging/ makes packages of them.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tanglebin)

# What programs outside may include; tests/package compiles each by itself.
set(public_headers
  base/error base/estimate base/random
  geometry/bin geometry/camera geometry/capsule geometry/intersect geometry/labels geometry/mass_properties geometry/ray
  geometry/segment geometry/support geometry/tube
  cloud/cloud cloud/images cloud/label_colors
  io/configuration io/images io/mesh io/pcd io/ply io/read_cloud io/read_tubes
  generate/generate generate/tube_spec
  settle/overlap settle/settle settle/spawn
  scan/scan scan/scan_output scan/scanner scan/sensor
  recipe/case_id recipe/recipe
  simulate/simulate simulate/world_sdf
  model/model_tubes model/parameters model/tubes_json model/locate/locate
  model/axis/settings/axis_settings model/axis/settings/link_weights
  model/paper/paper_settings model/scene/evidence model/scene/finding model/scene/known_scene model/scene/model
  model/scene/segment_tree model/scene/shared_settings
  profile/profile
  scene/camera_file scene/read_measurement scene/read_scene scene/resolve_scene scene/scene scene/write_scene
  score/confusion score/metrics score/score score/score_clouds score/score_tubes)
foreach(header IN LISTS public_headers)
  get_filename_component(room ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/tanglebin/${header}.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tanglebin/${room}
          COMPONENT development)
endforeach()

install(TARGETS tanglebin_program COMPONENT program)
install(TARGETS tanglebin_core tanglebin_axis tanglebin_paper tanglebin_modelling tanglebin_simulation tanglebin_datasets
        EXPORT tanglebinTargets COMPONENT development)
install(EXPORT tanglebinTargets NAMESPACE tanglebin:: DESTINATION ${package_dir} COMPONENT development)

# With its version, such as libpcl_common.so.1.13: programs outside need no headers of the Point Cloud Library.
if(TANGLEBIN_HAS_PCL)
  get_filename_component(pcl_common ${pcl_common_file} NAME)
  string(REGEX REPLACE "(\\.so\\.[0-9]+\\.[0-9]+).*" "\\1" pcl_common ${pcl_common})
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tanglebinConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/tanglebinConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tanglebinConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tanglebinConfig.cmake ${PROJECT_BINARY_DIR}/tanglebinConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT development)
