# `cmake --install build --prefix P` gives P/bin/lutka, the library with its headers, the assets, and a package that
# find_package(Lutka) finds (tests/consumer uses it).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(LUTKA_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Lutka")
install(DIRECTORY src/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lutka" FILES_MATCHING PATTERN "*.hpp"
        PATTERN "editor" EXCLUDE)
install(DIRECTORY assets DESTINATION "${CMAKE_INSTALL_DATADIR}/lutka")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/lutka")
install(EXPORT LutkaTargets NAMESPACE Lutka:: DESTINATION "${LUTKA_PACKAGE_DIR}")
configure_package_config_file(cmake/LutkaConfig.cmake.in "${CMAKE_BINARY_DIR}/LutkaConfig.cmake"
                              INSTALL_DESTINATION "${LUTKA_PACKAGE_DIR}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/LutkaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/LutkaConfig.cmake" "${CMAKE_BINARY_DIR}/LutkaConfigVersion.cmake"
        DESTINATION "${LUTKA_PACKAGE_DIR}")
