# plumescout_proto(NAME proto_v1 PROTOS plumescout/v1/types.proto ... [GRPC])
#
# Generates C++ from .proto files below proto/ into one library, built once, without debug
# information and without our warnings; that of services in one piece. The same run writes the Python
# stubs.
function(plumescout_proto name)
  cmake_parse_arguments(ARG "GRPC" "" "PROTOS" ${ARGN})
  set(root ${PROJECT_SOURCE_DIR}/proto)
  set(out ${CMAKE_BINARY_DIR}/generated)
  set(python_out ${CMAKE_BINARY_DIR}/python)
  file(MAKE_DIRECTORY ${out} ${python_out})
  set(sources)
  foreach(proto ${ARG_PROTOS})
    string(REGEX REPLACE "\\.proto$" "" base ${proto})
    set(outputs ${out}/${base}.pb.cc ${out}/${base}.pb.h)
    set(arguments --cpp_out=${out} --python_out=${python_out})
    if(ARG_GRPC)
      list(APPEND outputs ${out}/${base}.grpc.pb.cc ${out}/${base}.grpc.pb.h)
      list(APPEND arguments --grpc_out=${out}
           --plugin=protoc-gen-grpc=$<TARGET_FILE:gRPC::grpc_cpp_plugin>)
      if(GRPC_PYTHON_PLUGIN)
        list(APPEND arguments --grpc_python_out=${python_out}
             --plugin=protoc-gen-grpc_python=${GRPC_PYTHON_PLUGIN})
      endif()
    endif()
    add_custom_command(
      OUTPUT ${outputs}
      COMMAND protobuf::protoc -I${root} ${arguments} ${root}/${proto}
      DEPENDS ${root}/${proto} VERBATIM)
    foreach(output ${outputs})
      if(output MATCHES "\\.cc$")
        list(APPEND sources ${output})
      endif()
    endforeach()
  endforeach()
  add_custom_target(generated_${name} DEPENDS ${sources})
  if(ARG_GRPC AND PLUMESCOUT_UNITE)
    # (What is generated for messages has the same static names in every source.)
    set(services ${sources})
    list(FILTER services INCLUDE REGEX "\\.grpc\\.pb\\.cc$")
    set_source_files_properties(${services} PROPERTIES HEADER_FILE_ONLY ON)
    list(TRANSFORM services REPLACE "${out}/(.+)" "#include \"\\1\"\n")
    list(JOIN services "" text)
    file(CONFIGURE OUTPUT ${name}.grpc.cc CONTENT "${text}" @ONLY)
    list(APPEND sources ${CMAKE_CURRENT_BINARY_DIR}/${name}.grpc.cc)
  endif()
  add_library(plumescout_${name} STATIC ${sources})
  target_include_directories(plumescout_${name} SYSTEM PUBLIC $<BUILD_INTERFACE:${out}>)
  target_compile_options(plumescout_${name} PRIVATE -g0 ${PLUMESCOUT_OPTIONS_generated})
  if(PLUMESCOUT_SANITIZE MATCHES undefined)
    target_compile_options(plumescout_${name} PRIVATE -fno-sanitize=undefined)
  endif()
  target_link_libraries(plumescout_${name} PUBLIC protobuf::libprotobuf)
  if(ARG_GRPC)
    target_link_libraries(plumescout_${name} PUBLIC gRPC::grpc++)
  endif()
  add_library(plumescout::${name} ALIAS plumescout_${name})
endfunction()

# plumescout_proto_descriptors(proto_config PROTO plumescout/config/v1/server_config.proto
#                              IMPORTS plumescout/v1/options.proto)
#
# Adds plumescout/config/v1/server_config.descriptors.inc to the library's generated files: the bytes
# of a FileDescriptorSet of the .proto file and what it imports, with comments.
function(plumescout_proto_descriptors name)
  cmake_parse_arguments(ARG "" "PROTO" "IMPORTS" ${ARGN})
  set(root ${PROJECT_SOURCE_DIR}/proto)
  string(REGEX REPLACE "\\.proto$" "" base ${CMAKE_BINARY_DIR}/generated/${ARG_PROTO})
  list(TRANSFORM ARG_IMPORTS PREPEND ${root}/ OUTPUT_VARIABLE imports)
  set(script ${PROJECT_SOURCE_DIR}/cmake/bytes.cmake)
  add_custom_command(
    OUTPUT ${base}.descriptors.inc
    COMMAND protobuf::protoc -I${root} --include_imports --include_source_info
            --descriptor_set_out=${base}.descriptors ${root}/${ARG_PROTO}
    COMMAND ${CMAKE_COMMAND} -DIN=${base}.descriptors -DOUT=${base}.descriptors.inc -P ${script}
    DEPENDS ${root}/${ARG_PROTO} ${imports} ${script} VERBATIM)
  add_custom_target(generated_${name}_descriptors DEPENDS ${base}.descriptors.inc)
  target_sources(plumescout_${name} PRIVATE ${base}.descriptors.inc)
  add_dependencies(plumescout_${name} generated_${name}_descriptors)
endfunction()

find_program(GRPC_PYTHON_PLUGIN grpc_python_plugin)
