option(PLUMESCOUT_BUILD_TESTS "Build the tests; needs the laboratory" ON)
option(PLUMESCOUT_BUILD_LAB "Build the laboratory; needs OMPL" ON)
option(PLUMESCOUT_SERVER_OMPL "Let servers offer the planners of OMPL (planning.rivals)" ON)
option(PLUMESCOUT_ROS2 "Build plumescout-ros2, if Cyclone DDS is installed" ON)
option(PLUMESCOUT_BUILD_BENCHES "Build lab/bench" ON)
option(PLUMESCOUT_UNITE "Compile several sources at a time: half the time of a whole build" ON)
option(PLUMESCOUT_FUZZ "Build the fuzzing targets of tests/fuzz; needs clang" OFF)
if(PLUMESCOUT_BUILD_TESTS AND NOT PLUMESCOUT_BUILD_LAB)
  message(FATAL_ERROR "PLUMESCOUT_BUILD_LAB=OFF needs PLUMESCOUT_BUILD_TESTS=OFF: tests are run on worlds of the laboratory")
endif()
set(PLUMESCOUT_SUITES ".*" CACHE STRING "Folders below tests/ to build and register, by regex")
set(PLUMESCOUT_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# The same bytes on every machine: no contraction of a*b+c into one rounding.
add_compile_options(-ffp-contract=off)
# As protobuf's users are compiled, and precompiled headers must be like their users.
add_compile_options(-pthread)

# Who hangs is stopped; sanitizers make tests several times slower.
set(PLUMESCOUT_TEST_TIMEOUT_S 120)
if(PLUMESCOUT_SANITIZE)
  set(PLUMESCOUT_TEST_TIMEOUT_S 400)
  add_compile_options(-fsanitize=${PLUMESCOUT_SANITIZE} -fno-sanitize-recover=undefined
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PLUMESCOUT_SANITIZE})
endif()

# Any clone finds what another has compiled: paths in objects and in the cache are relative.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    list(APPEND CMAKE_CXX_COMPILER_LAUNCHER CCACHE_PCH_EXTSUM=1 ${CMAKE_SOURCE_DIR}/cmake/ccache_clang)
  endif()
  list(APPEND CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
add_compile_options(-ffile-prefix-map=${CMAKE_SOURCE_DIR}/=)

find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
  add_link_options(-fuse-ld=mold)
endif()

# What sources of a kind, by what they include (precompiled.cmake), are compiled with, after the
# options of the configuration. Where calls are waited for (wire) -O3 brings nothing, and under
# sanitizers no optimisation pays at all. Tests are compiled once and run for seconds: little
# optimisation pays, and less by clang.
set(PLUMESCOUT_OPTIONS_base)
set(PLUMESCOUT_OPTIONS_wire $<$<CONFIG:Release>:-O2>)
set(PLUMESCOUT_OPTIONS_generated -O1)
if(PLUMESCOUT_SANITIZE)
  set(PLUMESCOUT_OPTIONS_wire -O0)
  set(PLUMESCOUT_OPTIONS_generated -O0)
endif()
set(PLUMESCOUT_OPTIONS_tests -O1)
set(PLUMESCOUT_OPTIONS_wire_tests -O0)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options(-fpch-preprocess)  # ccache asks for it
  # GCC collects its garbage from 128 MiB on, and several sources at a time always have more: an eighth
  # of the time of tests.
  add_compile_options("SHELL:--param ggc-min-heapsize=524288")
elseif(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  set(PLUMESCOUT_OPTIONS_tests -O0)
endif()

# Warnings of our own code; generated and vendored code is built without them.
add_library(plumescout_warnings INTERFACE)
target_compile_options(plumescout_warnings INTERFACE -Wall -Wextra -Wconversion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlaps and ends of objects in std::string = "literal" that are not there (its bugs
  # 105651 and 105329); it says so of precompiled system headers too.
  target_compile_options(plumescout_warnings INTERFACE -Wno-restrict -Wno-array-bounds
                         -Wno-stringop-overread)
endif()
if(PLUMESCOUT_UNITE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Unnamed namespaces of what a united source includes are still those of one source.
  target_compile_options(plumescout_warnings INTERFACE -Wno-subobject-linkage)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # -Wconversion of GCC leaves signs alone in C++; so does ours.
  target_compile_options(plumescout_warnings INTERFACE -Wthread-safety -Wno-sign-conversion)
endif()
