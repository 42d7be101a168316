# Headers that are read once: parsing them is three quarters of the time that a source takes.
#
#   plumescout_precompile(target base)   base, wire; of tests: tests, wire_tests
#
# The header of a kind is compiled with the options of our own code, so only targets that have those
# may take it over.
option(PLUMESCOUT_PRECOMPILE "Precompile headers" ON)

foreach(kind base wire tests wire_tests)
  if(NOT PLUMESCOUT_PRECOMPILE OR (kind MATCHES "tests" AND NOT PLUMESCOUT_BUILD_TESTS))
    continue()
  endif()
  set(holder plumescout_precompiled_${kind})
  add_library(${holder} STATIC cmake/precompiled/source.cc)
  target_include_directories(${holder} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${holder} PRIVATE plumescout_warnings absl::statusor absl::str_format)
  if(kind MATCHES "wire")
    target_link_libraries(${holder} PRIVATE gRPC::grpc++)
  endif()
  if(kind MATCHES "tests")
    target_link_libraries(${holder} PRIVATE GTest::gmock)
  endif()
  target_compile_options(${holder} PRIVATE ${PLUMESCOUT_OPTIONS_${kind}})
  target_precompile_headers(${holder} PRIVATE <cmake/precompiled/${kind}.h>)
endforeach()

function(plumescout_precompile target kind)
  target_compile_options(${target} PRIVATE ${PLUMESCOUT_OPTIONS_${kind}})
  if(PLUMESCOUT_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM plumescout_precompiled_${kind})
  endif()
endfunction()
