# The parts of the Point Cloud Library that model tubes, as one target. Not find_package(PCL), which asks for VTK;
# nor its pkg-config files, which bring HDF5 and MPI.
find_package(Boost REQUIRED)
find_package(Eigen3 REQUIRED)
find_path(PCL_INCLUDE_DIR pcl/point_cloud.h PATH_SUFFIXES pcl-1.15 pcl-1.14 pcl-1.13 REQUIRED)
if(NOT TARGET pcl::modelling)
  add_library(pcl::modelling INTERFACE IMPORTED)
  target_include_directories(pcl::modelling SYSTEM INTERFACE ${PCL_INCLUDE_DIR})
  target_link_libraries(pcl::modelling INTERFACE Boost::headers Eigen3::Eigen)
  foreach(module segmentation features sample_consensus search kdtree common)
    find_library(PCL_${module}_LIBRARY pcl_${module} REQUIRED)
    target_link_libraries(pcl::modelling INTERFACE ${PCL_${module}_LIBRARY})
  endforeach()
endif()
