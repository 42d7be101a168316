# Sets `united` to sources that include those given, by paths relative to the root, sixteen at a time:
# most of the time that a source takes is for what it includes. Names of unnamed namespaces must not
# meet within a library; each test keeps to a namespace of its own. (CMake's UNITY_BUILD names sources
# by absolute paths, which no compiler cache of another clone knows.)
function(plumescout_unite united target)
  if(NOT PLUMESCOUT_UNITE OR ARGC EQUAL 3)
    list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/)
    set(${united} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(made)
  set(left ${ARGN})
  while(left)
    list(SUBLIST left 0 16 batch)
    list(REMOVE_ITEM left ${batch})
    list(LENGTH made number)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}_${number}.cc)
    list(TRANSFORM batch REPLACE "(.+)" "#include \"\\1\"\n")
    list(JOIN batch "" text)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    list(APPEND made ${file})
  endwhile()
  set(${united} ${made} PARENT_SCOPE)
endfunction()

# plumescout_library(core_gas SOURCES a.cc b.cc DEPS plumescout::core_linalg absl::status)
#
# Makes the library plumescout_core_gas with the alias plumescout::core_gas. Includes are relative
# to the root of the repository. Without sources the library is an INTERFACE (headers only).
# PRECOMPILED names the headers that are read once, if not `base`. APART: sources among them that are
# compiled singly, for names of their unnamed namespaces are also those of others.
function(plumescout_library name)
  cmake_parse_arguments(ARG "" "PRECOMPILED" "SOURCES;APART;DEPS" ${ARGN})
  if(NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED base)
  endif()
  if(ARG_SOURCES OR ARG_APART)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    set(united)
    if(ARG_SOURCES)
      list(TRANSFORM ARG_SOURCES PREPEND ${folder}/ OUTPUT_VARIABLE sources)
      plumescout_unite(united ${name} ${sources})
    endif()
    add_library(plumescout_${name} STATIC ${united} ${ARG_APART})
    plumescout_precompile(plumescout_${name} ${ARG_PRECOMPILED})
    target_include_directories(plumescout_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    target_link_libraries(plumescout_${name} PUBLIC ${ARG_DEPS}
                          PRIVATE $<BUILD_INTERFACE:plumescout_warnings>)
  else()
    add_library(plumescout_${name} INTERFACE)
    target_include_directories(plumescout_${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(plumescout_${name} INTERFACE ${ARG_DEPS})
  endif()
  add_library(plumescout::${name} ALIAS plumescout_${name})
endfunction()

# plumescout_program(plumescout-server SOURCES main.cc DEPS plumescout::server)
#
# PRECOMPILED: as plumescout_library, if any. COMPONENT: of the installation, if it is installed.
function(plumescout_program name)
  cmake_parse_arguments(ARG "" "PRECOMPILED;COMPONENT" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  if(ARG_COMPONENT)
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${ARG_COMPONENT})
  endif()
  if(ARG_PRECOMPILED)
    plumescout_precompile(${name} ${ARG_PRECOMPILED})
  endif()
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} plumescout_warnings)
endfunction()

# plumescout_tests(core/gas DEPS plumescout::core_gas)
#
# Builds every *_test.cc in and below tests/core/gas into the program core_gas_tests. CTest has one
# test for each file, under its path: core/gas/posterior_test. Sources are compiled several at a
# time, which halves the time: each keeps to a namespace of its own name. OPTIMISE: what they compare
# with, dense matrices, would run for minutes without. EXCLUDE: sources to leave out, by regex.
function(plumescout_tests folder)
  cmake_parse_arguments(ARG "OPTIMISE" "PRECOMPILED;EXCLUDE" "DEPS" ${ARGN})
  if(NOT folder MATCHES "${PLUMESCOUT_SUITES}")
    return()
  endif()
  if(NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED tests)
  endif()
  string(REPLACE "/" "_" target ${folder}_tests)
  file(GLOB_RECURSE sources RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
       ${PROJECT_SOURCE_DIR}/tests/${folder}/*_test.cc)
  if(ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX ${ARG_EXCLUDE})
  endif()
  plumescout_unite(united ${target} ${sources})
  plumescout_program(${target} SOURCES ${united} DEPS ${ARG_DEPS} plumescout::tests_main)
  if(ARG_OPTIMISE AND NOT PLUMESCOUT_OPTIONS_tests STREQUAL "-O1")
    target_compile_options(${target} PRIVATE -O1)
  else()
    plumescout_precompile(${target} ${ARG_PRECOMPILED})
  endif()
  if(TARGET plumescout_tsan_absl)
    add_dependencies(${target} plumescout_tsan_absl)  # preloaded
  endif()
  foreach(source ${sources})
    string(REGEX REPLACE "^tests/(.*)\\.cc$" "\\1" name ${source})
    add_test(NAME ${name} COMMAND ${target} --source=${source}
             WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${PLUMESCOUT_TEST_TIMEOUT_S}
                         ENVIRONMENT "${PLUMESCOUT_TEST_ENVIRONMENT}")
  endforeach()
  set_property(GLOBAL APPEND PROPERTY PLUMESCOUT_TEST_PROGRAMS ${target})
endfunction()

# plumescout_bench(gas_bench DEPS plumescout::core_gas): lab/bench/gas_bench.cc
function(plumescout_bench name)
  if(PLUMESCOUT_BUILD_BENCHES)
    plumescout_program(${name} SOURCES ${name}.cc ${ARGN})
  endif()
endfunction()
