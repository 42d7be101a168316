# plumescout_library(core_gas SOURCES a.cc b.cc DEPS plumescout::core_linalg absl::status)
#
# Makes the library plumescout_core_gas with the alias plumescout::core_gas. Includes are relative
# to the root of the repository. Without SOURCES the library is an INTERFACE (headers only).
function(plumescout_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  if(ARG_SOURCES)
    add_library(plumescout_${name} STATIC ${ARG_SOURCES})
    target_include_directories(plumescout_${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(plumescout_${name} PUBLIC ${ARG_DEPS} PRIVATE plumescout_warnings)
  else()
    add_library(plumescout_${name} INTERFACE)
    target_include_directories(plumescout_${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(plumescout_${name} INTERFACE ${ARG_DEPS})
  endif()
  add_library(plumescout::${name} ALIAS plumescout_${name})
endfunction()

# plumescout_program(plumescout-server SOURCES main.cc DEPS plumescout::server)
function(plumescout_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} plumescout_warnings)
endfunction()

# plumescout_test(core/gas/posterior_test DEPS plumescout::core_gas)
#
# Builds tests/core/gas/posterior_test.cc into one program, registered with CTest under its path.
function(plumescout_test path)
  cmake_parse_arguments(ARG "" "TIMEOUT" "DEPS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  string(REPLACE "/" "_" target ${path})
  plumescout_program(${target} SOURCES ${PROJECT_SOURCE_DIR}/tests/${path}.cc
                     DEPS ${ARG_DEPS} GTest::gmock_main)
  if(TARGET plumescout_tsan_absl)
    add_dependencies(${target} plumescout_tsan_absl)  # preloaded
  endif()
  add_test(NAME ${path} COMMAND ${target} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${path} PROPERTIES TIMEOUT ${ARG_TIMEOUT}
                       ENVIRONMENT "${PLUMESCOUT_TEST_ENVIRONMENT}")
endfunction()

# plumescout_bench(gas_bench DEPS plumescout::core_gas): lab/bench/gas_bench.cc
function(plumescout_bench name)
  if(PLUMESCOUT_BUILD_BENCHES)
    plumescout_program(${name} SOURCES ${name}.cc ${ARGN})
  endif()
endfunction()
