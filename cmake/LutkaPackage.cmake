# `cmake --install build --prefix P` gives P/bin/lutka, the library with its headers, the assets, and a package that
# find_package(Lutka) finds (tests/consumer uses it). The component `program` alone is what the Debian package holds
# (tools/package).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(LUTKA_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Lutka")
install(CODE "set(LUTKA_SOURCE_DIR \"${PROJECT_SOURCE_DIR}\")\nset(LUTKA_INCLUDE_DIR \"${CMAKE_INSTALL_INCLUDEDIR}\")")
install(SCRIPT cmake/LutkaInstallHeaders.cmake)
install(DIRECTORY assets DESTINATION "${CMAKE_INSTALL_DATADIR}/lutka" COMPONENT program)
install(FILES LICENSE CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/lutka" COMPONENT program)
install(FILES cmake/package/lutka.desktop DESTINATION "${CMAKE_INSTALL_DATADIR}/applications" COMPONENT program)
install(FILES cmake/package/lutka-mime.xml DESTINATION "${CMAKE_INSTALL_DATADIR}/mime/packages" COMPONENT program RENAME lutka.xml)
install(FILES cmake/package/lutka.svg DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps" COMPONENT program)
install(FILES cmake/package/lutka.bash-completion DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
        COMPONENT program RENAME lutka)
install(EXPORT LutkaTargets NAMESPACE Lutka:: DESTINATION "${LUTKA_PACKAGE_DIR}")
configure_package_config_file(cmake/LutkaConfig.cmake.in "${CMAKE_BINARY_DIR}/LutkaConfig.cmake"
                              INSTALL_DESTINATION "${LUTKA_PACKAGE_DIR}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/LutkaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/LutkaConfig.cmake" "${CMAKE_BINARY_DIR}/LutkaConfigVersion.cmake"
        DESTINATION "${LUTKA_PACKAGE_DIR}")

# Man pages, one for the program and one a command as git has them, made from what `--help` prints.
find_program(LUTKA_HELP2MAN help2man)
find_program(LUTKA_GZIP gzip)
if(LUTKA_HELP2MAN AND LUTKA_GZIP)
  get_property(commands GLOBAL PROPERTY LUTKA_COMMANDS)
  set(man_pages "")
  foreach(command IN ITEMS "" ${commands})
    string(REGEX REPLACE "-$" "" page "lutka-${command}")
    set(man_file "${CMAKE_BINARY_DIR}/man/${page}.1.gz")
    add_custom_command(OUTPUT "${man_file}" DEPENDS lutka
      COMMAND ${CMAKE_COMMAND} -E make_directory "${CMAKE_BINARY_DIR}/man"
      COMMAND sh -c "'${LUTKA_HELP2MAN}' --no-info --no-discard-stderr --version-string=${PROJECT_VERSION} --name='ragdolls of rigged characters' '${CMAKE_BINARY_DIR}/lutka ${command}' | '${LUTKA_GZIP}' -9n >'${man_file}'"
      COMMENT "Man page ${page}(1)" VERBATIM)
    list(APPEND man_pages "${man_file}")
  endforeach()
  add_custom_target(lutka_man ALL DEPENDS ${man_pages})
  install(FILES ${man_pages} DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
endif()

# `cpack -G DEB`: lutka_VERSION_ARCHITECTURE.deb, whose libraries are found by dpkg-shlibdeps. What is only started or opened
# at run time is named here: ffmpeg writes films, Mesa draws where there is no driver, the fonts are the editor's, three.js goes into reports.
set(CPACK_PACKAGE_NAME lutka)
set(CPACK_PACKAGE_CONTACT "The Lutka developers <lutka@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "ffmpeg, fonts-dejavu-core, libgl1-mesa-dri, libjs-three")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
