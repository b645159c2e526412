# All third parties in one place. Each is linked PRIVATE by the one folder that includes it (see docs/architecture.md).
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

find_package(glm REQUIRED)
if(NOT TARGET glm::glm)
  add_library(glm::glm INTERFACE IMPORTED)
endif()
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)
find_package(assimp REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(ZLIB REQUIRED)
find_package(CLI11 REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(glfw3 REQUIRED)

# Bullet by pkg-config: the package's CMake CONFIG gives a relative include path.
pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet)
pkg_check_modules(draco REQUIRED IMPORTED_TARGET draco)
pkg_check_modules(egl REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(stb REQUIRED IMPORTED_TARGET stb)

# GLAD: generated at configure time by the Debian package python3-glad. `--reproducible` keeps it off the network, and
# the system's python is named because another python3 on the PATH lacks the module.
set(LUTKA_GLAD_DIR "${CMAKE_BINARY_DIR}/glad")
if(NOT EXISTS "${LUTKA_GLAD_DIR}/src/gl.c" AND NOT EXISTS "${LUTKA_GLAD_DIR}/src/glad.c")
  find_program(LUTKA_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
  execute_process(
    COMMAND "${LUTKA_PYTHON}" -m glad --reproducible --out-path "${LUTKA_GLAD_DIR}" --api gl:core=3.3 c
    RESULT_VARIABLE glad_result OUTPUT_VARIABLE glad_output ERROR_VARIABLE glad_output)
  if(NOT glad_result EQUAL 0)
    message(FATAL_ERROR "GLAD could not be generated (package python3-glad): ${glad_output}")
  endif()
endif()
file(GLOB LUTKA_GLAD_SOURCE "${LUTKA_GLAD_DIR}/src/*.c")
add_library(lutka_glad STATIC ${LUTKA_GLAD_SOURCE})
target_include_directories(lutka_glad SYSTEM PUBLIC $<BUILD_INTERFACE:${LUTKA_GLAD_DIR}/include>)
install(TARGETS lutka_glad EXPORT LutkaTargets)
target_link_libraries(lutka_glad PUBLIC ${CMAKE_DL_LIBS})
set_target_properties(lutka_glad PROPERTIES POSITION_INDEPENDENT_CODE ON)

# Dear ImGui: the package's pkg-config puts the archive after glfw, which does not link; hence this target.
find_library(LUTKA_IMGUI_LIBRARY NAMES imgui REQUIRED)
find_path(LUTKA_IMGUI_INCLUDE_DIR NAMES imgui.h PATH_SUFFIXES imgui REQUIRED)
add_library(lutka_imgui STATIC IMPORTED)
set_target_properties(lutka_imgui PROPERTIES
  IMPORTED_LOCATION "${LUTKA_IMGUI_LIBRARY}"
  INTERFACE_INCLUDE_DIRECTORIES "${LUTKA_IMGUI_INCLUDE_DIR};${LUTKA_IMGUI_INCLUDE_DIR}/backends"
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${LUTKA_IMGUI_INCLUDE_DIR};${LUTKA_IMGUI_INCLUDE_DIR}/backends"
  INTERFACE_LINK_LIBRARIES "glfw;GL;PkgConfig::stb")
