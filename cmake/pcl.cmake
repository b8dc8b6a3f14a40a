# The parts of the Point Cloud Library that the paper's method needs, as one target, and whether they are installed:
# TANGLEBIN_HAS_PCL. Not find_package(PCL), which asks for VTK; nor its pkg-config files, which bring HDF5 and MPI.
# Its templates are compiled here: to load the libraries that have them for every type of point would take three times as
# long as all else that the program does before it begins. FLANN, which finds neighbours, packs what it saves with LZ4.
find_package(Boost REQUIRED)
find_package(Eigen3 REQUIRED)
find_path(PCL_INCLUDE_DIR pcl/segmentation/region_growing.h PATH_SUFFIXES pcl-1.15 pcl-1.14 pcl-1.13)
find_path(FLANN_INCLUDE_DIR flann/flann.hpp)
find_library(PCL_COMMON_LIBRARY pcl_common)
find_library(LZ4_LIBRARY lz4)
set(TANGLEBIN_HAS_PCL OFF)
if(PCL_INCLUDE_DIR AND FLANN_INCLUDE_DIR AND PCL_COMMON_LIBRARY AND LZ4_LIBRARY)
  set(TANGLEBIN_HAS_PCL ON)
  get_filename_component(pcl_common_file ${PCL_COMMON_LIBRARY} REALPATH)
  add_library(pcl::modelling INTERFACE IMPORTED)
  target_include_directories(pcl::modelling SYSTEM INTERFACE ${PCL_INCLUDE_DIR} ${FLANN_INCLUDE_DIR})
  target_compile_definitions(pcl::modelling INTERFACE PCL_NO_PRECOMPILE)
  target_link_libraries(pcl::modelling INTERFACE Boost::headers Eigen3::Eigen ${PCL_COMMON_LIBRARY} ${LZ4_LIBRARY})
endif()
