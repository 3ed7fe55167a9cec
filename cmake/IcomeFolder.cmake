# One folder under src/ is one library and one namespace; one folder under tests/ is one test program.

# icome_folder(NAME [USES folder...] [LINKS target...])
# USES are other folders of src/ (tools/check_layers.py holds them against tools/layers.txt);
# LINKS are third-party targets, private so that their headers stay behind this folder's sources.
function(icome_folder name)
  cmake_parse_arguments(ARG "" "" "USES;LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(TRANSFORM ARG_USES PREPEND icome_)
  if(NOT name STREQUAL "base")
    list(PREPEND ARG_USES icome_base)
  endif()
  if(NOT sources)  # headers only
    add_library(icome_${name} INTERFACE)
    target_include_directories(icome_${name} INTERFACE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(icome_${name} INTERFACE ${ARG_USES})
    return()
  endif()
  add_library(icome_${name} STATIC ${sources})
  target_include_directories(icome_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(icome_${name} PUBLIC ${ARG_USES} PRIVATE ${ARG_LINKS})
endfunction()

# Every unit test program, so that a sanitizer build makes these and what they need, and no more.
add_custom_target(icome_unit_tests)

# icome_tests(NAME [LINKS target...] [THREADED file...]): the *_test.cpp files of this folder as one GoogleTest
# program. Where only some of a folder's code is threaded, THREADED names the tests of it, which are all that the
# thread sanitizer runs.
function(icome_tests name)
  cmake_parse_arguments(ARG "" "" "LINKS;THREADED" ${ARGN})
  if(ICOME_SANITIZE STREQUAL "thread" AND ARG_THREADED)
    list(TRANSFORM ARG_THREADED PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  else()
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  endif()
  if(NOT sources)
    return()
  endif()
  set(program icome_${name}_tests)
  add_executable(${program} ${sources})
  add_dependencies(icome_unit_tests ${program})
  if(NOT ICOME_SANITIZE)
    # Most of the time goes into reading headers and optimising checks that run once: in fours and with
    # little of the latter a test program is built in 2/5 of it.
    set_target_properties(${program} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 4)
    target_compile_options(${program} PRIVATE -O1)
  endif()
  target_link_libraries(${program} PRIVATE icome_${name} GTest::gtest_main ${ARG_LINKS})
  target_include_directories(${program} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${program} PRIVATE
    ICOME_SHARED_DATA="${PROJECT_SOURCE_DIR}/../shared/data")
  if(ICOME_SANITIZE)
    # One process for the whole program: starting one for each test would cost more than the tests.
    add_test(NAME ${name} COMMAND ${program})
    set_tests_properties(${name} PROPERTIES LABELS unit TIMEOUT 600)
  else()
    gtest_discover_tests(${program} TEST_PREFIX "${name}/" DISCOVERY_MODE PRE_TEST
      PROPERTIES LABELS unit TIMEOUT 400)
  endif()
endfunction()

# icome_script_tests(NAME): each *_test.py of this folder as one test. The scripts find the program in
# the environment variable ICOME_PROGRAM and its version in ICOME_VERSION.
function(icome_script_tests name)
  file(GLOB scripts CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.py)
  foreach(script IN LISTS scripts)
    get_filename_component(test ${script} NAME_WE)
    add_test(NAME ${name}/${test} COMMAND python3 -B ${script})
    set_tests_properties(${name}/${test} PROPERTIES TIMEOUT 600 ENVIRONMENT
      "ICOME_PROGRAM=${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/icome;ICOME_VERSION=${PROJECT_VERSION}")
  endforeach()
endfunction()

# icome_benchmark(NAME [LINKS target...]): the sources of this folder as the program
# icome_NAME_benchmark, which `make bench` builds and runs.
function(icome_benchmark name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(program icome_${name}_benchmark)
  add_executable(${program} ${sources})
  target_link_libraries(${program} PRIVATE icome_base ${ARG_LINKS})
  set_property(GLOBAL APPEND PROPERTY ICOME_BENCHMARKS ${program})
endfunction()
