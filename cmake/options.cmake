option(PLUMESCOUT_BUILD_TESTS "Build the tests" ON)
option(PLUMESCOUT_BUILD_BENCHES "Build lab/bench" ON)
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

if(PLUMESCOUT_SANITIZE)
  add_compile_options(-fsanitize=${PLUMESCOUT_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PLUMESCOUT_SANITIZE})
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

# Warnings of our own code; generated and vendored code is built without them.
add_library(plumescout_warnings INTERFACE)
target_compile_options(plumescout_warnings INTERFACE -Wall -Wextra -Wconversion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees an overlap in std::string = "literal" that is not there (its bug 105651).
  target_compile_options(plumescout_warnings INTERFACE -Wno-restrict)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # -Wconversion of GCC leaves signs alone in C++; so does ours.
  target_compile_options(plumescout_warnings INTERFACE -Wthread-safety -Wno-sign-conversion)
endif()
