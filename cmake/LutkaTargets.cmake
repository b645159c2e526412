# One function for each kind of target, so that warnings, sanitizers and include roots are the same everywhere.

# Everything that our own targets, and only they, are compiled with.
add_library(lutka_options INTERFACE)
target_compile_options(lutka_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # Contracting a*b+c into one fused operation depends on compiler, flags and inlining: without this the same
  # simulation gives other bits in other builds, and the determinism tests (state hashes) mean nothing.
  -ffp-contract=off
  # GCC 12 reports these falsely from inside the standard library at -O2 and above (GCC bugs 105651, 105329),
  # the last one for glm vectors in initialiser lists.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-stringop-overflow -Wno-array-bounds -Wno-maybe-uninitialized>)
# A seventh of a build is GCC's search for memory to use again: half a gigabyte a file needs none.
target_compile_options(lutka_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
if(LUTKA_WARNINGS_AS_ERRORS)
  target_compile_options(lutka_options INTERFACE -Werror)
endif()
if(LUTKA_UNITY_BUILD)
  # GCC takes every .cpp that another file includes for a header, and warns of members with types of that file's own.
  target_compile_options(lutka_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(LUTKA_SANITIZE)
  target_compile_options(lutka_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
                         -fno-sanitize-recover=undefined)
  target_link_options(lutka_options INTERFACE -fsanitize=address,undefined)
endif()
if(LUTKA_SANITIZE_THREADS)
  target_compile_options(lutka_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(lutka_options INTERFACE -fsanitize=thread)
endif()
if(LUTKA_HARDEN)
  target_compile_options(lutka_options INTERFACE -D_GLIBCXX_ASSERTIONS -fstack-protector-strong
                         $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
endif()
if(LUTKA_FUZZ)
  target_compile_options(lutka_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-omit-frame-pointer
                         -fno-sanitize-recover=undefined)
  target_link_options(lutka_options INTERFACE -fsanitize=address,undefined)
endif()
if(LUTKA_CLANG_TIDY)
  find_program(LUTKA_CLANG_TIDY_EXE NAMES clang-tidy clang-tidy-16 clang-tidy-14 REQUIRED)
endif()

function(lutka_common target)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:lutka_options>)
  # Most of a file's compile time are its headers; some thirty files share them. Names without linkage must then be unique in a
  # target.
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${LUTKA_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 30)
  if(LUTKA_CLANG_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY "${LUTKA_CLANG_TIDY_EXE};--quiet")
  endif()
endfunction()

# -O1 for a target that waits for people, files or other targets: a quarter of its compile time is the optimiser's rest.
function(lutka_cold target)
  target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>)
endfunction()

# lutka_library(NAME SOURCES … LINK … [PRIVATE_LINK …]): a static library `lutka_NAME`, alias `Lutka::NAME`.
# LINK holds the layers that its headers use; a third party that only its sources include goes to PRIVATE_LINK.
# INTERNAL keeps a library out of the installed package. HOT: what it does each frame is worth the optimiser's longest work;
# COLD: nothing in it is.
function(lutka_library name)
  cmake_parse_arguments(ARG "INTERNAL;HOT;COLD" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(lutka_${name} STATIC ${ARG_SOURCES})
  add_library(Lutka::${name} ALIAS lutka_${name})
  set_target_properties(lutka_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(lutka_${name} PUBLIC cxx_std_20)
  target_include_directories(lutka_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lutka>)
  target_link_libraries(lutka_${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  lutka_common(lutka_${name})
  if(ARG_HOT)
    target_compile_options(lutka_${name} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O3>)
  elseif(ARG_COLD)
    lutka_cold(lutka_${name})
  endif()
  if(NOT ARG_INTERNAL)
    install(TARGETS lutka_${name} EXPORT LutkaTargets)
  endif()
endfunction()

# lutka_test(NAME SOURCES … LINK …): a Catch2 executable `test_NAME`, each of its test cases one CTest test.
function(lutka_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${name} PRIVATE ${ARG_LINK} lutka_test_support)
  target_compile_definitions(test_${name} PRIVATE
    LUTKA_ZOO_DIR="${LUTKA_ZOO_DIR}" LUTKA_ASSETS_DIR="${PROJECT_SOURCE_DIR}/assets"
    LUTKA_TESTS_DIR="${PROJECT_SOURCE_DIR}/tests" LUTKA_BINARY="${CMAKE_BINARY_DIR}/lutka")
  lutka_common(test_${name})
  lutka_cold(test_${name})
  # GCC inlines an operator new that it sees, and then finds that its memory is given to `free`.
  set_source_files_properties("${PROJECT_SOURCE_DIR}/tests/support/counting_new.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  # `-w NoTests`: a name that matches nothing fails instead of passing without having run.
  catch_discover_tests(test_${name} TEST_PREFIX "${name}: " EXTRA_ARGS -w NoTests
                       PROPERTIES TIMEOUT 600 ENVIRONMENT "LUTKA_GL_DEBUG=1" SKIP_REGULAR_EXPRESSION "lutka-test-skipped: ")
endfunction()
