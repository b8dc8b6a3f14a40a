# cmake --install: the program, the library, its headers and the package file that find_package(tanglebin) reads.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tanglebin)

install(TARGETS tanglebin_program)
install(TARGETS tanglebin EXPORT tanglebinTargets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tanglebin DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp" PATTERN cli EXCLUDE)
install(EXPORT tanglebinTargets NAMESPACE tanglebin:: DESTINATION ${package_dir})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tanglebinConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/tanglebinConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tanglebinConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tanglebinConfig.cmake ${PROJECT_BINARY_DIR}/tanglebinConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/pcl.cmake
        DESTINATION ${package_dir})
