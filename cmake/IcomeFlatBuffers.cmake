# icome_flatbuffers(TARGET schema.fbs...): makes <name_generated.h> of each schema for the sources of TARGET.
# While configuring, as base/version.h is made, so that tools/check-names needs no build.
find_program(FLATC_PROGRAM flatc REQUIRED)

function(icome_flatbuffers target)
  set(headers ${PROJECT_BINARY_DIR}/generated/flatbuffers/${target})
  set(fresh ${headers}/fresh)
  execute_process(
    COMMAND ${FLATC_PROGRAM} --cpp --scoped-enums -o ${fresh} ${ARGN}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} COMMAND_ERROR_IS_FATAL ANY)
  foreach(schema IN LISTS ARGN)
    get_filename_component(name ${schema} NAME_WE)
    # A header that is the same keeps its age: nothing is compiled again.
    file(COPY_FILE ${fresh}/${name}_generated.h ${headers}/${name}_generated.h ONLY_IF_DIFFERENT)
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
  # As a system's, since warnings about what flatc writes help nobody.
  target_include_directories(${target} SYSTEM PRIVATE ${headers})
endfunction()
