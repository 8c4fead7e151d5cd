# What leaves the build tree: the symbols the shared libraries export, and an installation of
# libraries, public headers, softsound, a CMake package `ode_softbody` with the targets
# ode_softbody::ode_softbody and ode_softbody::ode_sound, pkg-config files, and a Debian package
# (`cpack --config build/release/CPackConfig.cmake`).
include(CMakePackageConfigHelpers)

set(libraries ode_softbody ode_sound)
set(exports ${PROJECT_SOURCE_DIR}/cmake/exports.map)
foreach(library ${libraries})
    target_link_options(${library} PRIVATE LINKER:--version-script=${exports})
    set_property(TARGET ${library} APPEND PROPERTY LINK_DEPENDS ${exports})
endforeach()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ode_softbody)

# libode_sound finds libode_softbody beside itself wherever the tree is moved to.
set_target_properties(${libraries} PROPERTIES INSTALL_RPATH "$ORIGIN")
install(TARGETS ${libraries} EXPORT ode_softbody LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ode_softbody/include/ode_softbody sound/include/ode_sound
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET softsound)
    file(RELATIVE_PATH to_libraries /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
    set_target_properties(softsound PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")
    install(TARGETS softsound RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(EXPORT ode_softbody NAMESPACE ode_softbody:: FILE ode_softbody-targets.cmake
        DESTINATION ${package_dir})
configure_package_config_file(cmake/ode_softbody-config.cmake.in ode_softbody-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(ode_softbody-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ode_softbody-config.cmake
              ${PROJECT_BINARY_DIR}/ode_softbody-config-version.cmake cmake/FindODE.cmake
        DESTINATION ${package_dir})

# The prefix in a .pc file is found from where the file lies, so that an installed tree can move.
file(RELATIVE_PATH pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
foreach(library ${libraries})
    configure_file(cmake/${library}.pc.in ${library}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${library}.pc
            DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME libode-softbody-dev)
set(CPACK_PACKAGE_CONTACT "the ode_softbody developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libode-dev)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# dpkg-shlibdeps must find our own library among the files being packed.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_STRIP_FILES ON)
include(CPack)
