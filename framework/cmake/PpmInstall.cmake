# What `cmake --install` puts in place: the command, the libraries with their headers, and the package that find_package(ppm) finds.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/ppm)
install(TARGETS ppm_framework ppm_maps EXPORT ppmTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ppm)
install(TARGETS ppm_rawlog LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/framework ${CMAKE_BINARY_DIR}/generated/framework
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ppm FILES_MATCHING PATTERN "*.hpp" PATTERN cmake EXCLUDE)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/modules/maps
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ppm/modules FILES_MATCHING PATTERN "*.hpp"
        PATTERN octomap EXCLUDE PATTERN tsdf EXCLUDE)  # of the plug-ins that ship
install(DIRECTORY ${CMAKE_SOURCE_DIR}/configs DESTINATION ${CMAKE_INSTALL_DATADIR}/ppm)
install(EXPORT ppmTargets NAMESPACE ppm:: DESTINATION ${package})
configure_package_config_file(${CMAKE_SOURCE_DIR}/framework/cmake/ppmConfig.cmake.in ${CMAKE_BINARY_DIR}/ppmConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/ppmConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/ppmConfig.cmake ${CMAKE_BINARY_DIR}/ppmConfigVersion.cmake
              ${CMAKE_SOURCE_DIR}/framework/cmake/PpmPlugin.cmake DESTINATION ${package})
