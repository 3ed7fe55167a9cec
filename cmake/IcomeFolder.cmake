# One folder under src/ is one library and one namespace; one folder under tests/ is one test program.

# icome_folder(NAME [USES folder...] [LINKS target...])
# USES are other folders of src/ (checked against the include lines by tools/check_layers.py);
# LINKS are third-party targets, private so that their headers stay behind this folder's sources.
function(icome_folder name)
  cmake_parse_arguments(ARG "" "" "USES;LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(icome_${name} STATIC ${sources})
  target_include_directories(icome_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  if(NOT name STREQUAL "base")
    target_link_libraries(icome_${name} PUBLIC icome_base)
  endif()
  foreach(use IN LISTS ARG_USES)
    target_link_libraries(icome_${name} PUBLIC icome_${use})
  endforeach()
  target_link_libraries(icome_${name} PRIVATE ${ARG_LINKS})
endfunction()

# icome_tests(NAME [LINKS target...]): the *_test.cpp files of this folder as one GoogleTest program.
function(icome_tests name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_executable(icome_${name}_tests ${sources})
  target_link_libraries(icome_${name}_tests PRIVATE icome_${name} GTest::gtest_main ${ARG_LINKS})
  target_compile_definitions(icome_${name}_tests PRIVATE
    ICOME_SHARED_DATA="${PROJECT_SOURCE_DIR}/../shared/data")
  gtest_discover_tests(icome_${name}_tests TEST_PREFIX "${name}/" DISCOVERY_MODE PRE_TEST
    PROPERTIES LABELS ${name})
endfunction()
