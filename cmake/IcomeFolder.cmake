# One folder under src/ is one library and one namespace; one folder under tests/ is one test program.

# icome_sources(TARGET source...): compiles the sources as part of the target, in batches of at most ICOME_BATCH where
# that is set, since what sources include costs more than they do. A batch is a generated source that includes them by
# their path in the project, so that the compiler cache knows it in every clone (CMAKE_UNITY_BUILD writes absolute paths
# into its own). A batch that is half full ends after a source whose name's hash says so, and has the name of its first
# source's hash: a source more or less then changes the batch that it is in and perhaps the next, not all of its folder.
function(icome_sources target)
  list(LENGTH ARGN count)
  if(NOT ICOME_BATCH OR count LESS 2)
    target_sources(${target} PRIVATE ${ARGN})
    return()
  endif()
  set(size 0)
  foreach(source IN LISTS ARGN)
    file(RELATIVE_PATH source ${PROJECT_SOURCE_DIR} ${source})
    string(SHA1 hash ${source})
    if(size EQUAL 0)
      string(SUBSTRING ${hash} 0 8 first)
      set(text "")
    endif()
    string(APPEND text "#include \"${source}\"\n")
    math(EXPR size "${size} + 1")
    math(EXPR twice "2 * ${size}")
    math(EXPR count "${count} - 1")
    if(count EQUAL 0 OR size EQUAL ICOME_BATCH OR (twice GREATER_EQUAL ICOME_BATCH AND hash MATCHES "^[0-3]"))
      set(generated ${CMAKE_CURRENT_BINARY_DIR}/batches/${target}_${first}.cpp)
      file(CONFIGURE OUTPUT ${generated} CONTENT "${text}" @ONLY)
      target_sources(${target} PRIVATE ${generated})
      set(size 0)
    endif()
  endforeach()
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
endfunction()

# icome_folder(NAME [USES folder...] [LINKS target...] [EXCEPT folder...] [LEAVES_COMPUTING])
# USES are other folders of src/ (tools/check_layers.py holds them against tools/layers.txt);
# LINKS are third-party targets, private so that their headers stay behind this folder's sources;
# EXCEPT are folders in this one that are targets of their own.
# LEAVES_COMPUTING: the folder leaves computing to others, so that builds with sanitizers, which run each test once, do
# not optimise it: clang then takes half as long to compile it.
function(icome_folder name)
  cmake_parse_arguments(ARG "LEAVES_COMPUTING" "" "USES;LINKS;EXCEPT" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(folder IN LISTS ARG_EXCEPT)
    file(GLOB_RECURSE others ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
    list(REMOVE_ITEM sources ${others})
  endforeach()
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
  add_library(icome_${name} STATIC)
  icome_sources(icome_${name} ${sources})
  if(ICOME_SANITIZE AND ARG_LEAVES_COMPUTING)
    target_compile_options(icome_${name} PRIVATE -O0)
  endif()
  target_include_directories(icome_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(icome_${name} PUBLIC ${ARG_USES} PRIVATE ${ARG_LINKS})
endfunction()

# Where the files are that tests and benchmarks read: paths of this clone, so they are in one source, and the compiler
# cache knows all others in every clone.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/places.cpp @ONLY CONTENT [[
#include "places.h"

namespace icome::places {

std::filesystem::path project_folder() { return "@PROJECT_SOURCE_DIR@"; }
std::filesystem::path shared_data() { return project_folder().parent_path() / "shared" / "data"; }

}  // namespace icome::places
]])
add_library(icome_places STATIC EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/generated/places.cpp)
target_include_directories(icome_places PUBLIC ${PROJECT_SOURCE_DIR}/tests)

# Every unit test program, so that a sanitizer build makes these and what they need, and no more.
add_custom_target(icome_unit_tests)

# icome_unit_test(NAME PROGRAM [SHARDS]): the tests of a GoogleTest program in so many processes (1), which may run side
# by side: a process for each test would cost more than most tests. To run one: PROGRAM --gtest_filter=Suite.Name
function(icome_unit_test name program)
  set(shards 1)
  if(ARGN)
    set(shards ${ARGN})
  endif()
  foreach(shard RANGE 1 ${shards})
    set(test ${name})
    if(shards GREATER 1)
      set(test ${name}/${shard}of${shards})
    endif()
    math(EXPR index "${shard} - 1")
    add_test(NAME ${test} COMMAND ${program})
    set_tests_properties(${test} PROPERTIES LABELS unit TIMEOUT 600
      ENVIRONMENT "GTEST_BRIEF=1;GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()

# icome_tests(NAME [LINKS target...] [THREADED file...] [UNTHREADED file...] [EXCEPT file...] [SHARDS n] [COMPUTES]): the
# *_test.cpp files of this folder as one GoogleTest program, run as icome_unit_test says. Where only some of a folder's
# code is threaded, THREADED names the tests of it, which are all that the thread sanitizer runs; where most of it is,
# UNTHREADED names the others. EXCEPT names sources that belong to other targets. COMPUTES: the tests hold much against
# brute force of their own, so that they are optimised a little; that takes clang three times as long to compile.
function(icome_tests name)
  cmake_parse_arguments(ARG "COMPUTES" "SHARDS" "LINKS;THREADED;UNTHREADED;EXCEPT" ${ARGN})
  if(ICOME_SANITIZE STREQUAL "thread" AND ARG_THREADED)
    list(TRANSFORM ARG_THREADED PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  else()
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    if(ICOME_SANITIZE STREQUAL "thread" AND ARG_UNTHREADED)
      list(TRANSFORM ARG_UNTHREADED PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
      list(REMOVE_ITEM sources ${ARG_UNTHREADED})
    endif()
    list(TRANSFORM ARG_EXCEPT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    list(REMOVE_ITEM sources ${ARG_EXCEPT})
  endif()
  if(NOT sources)
    return()
  endif()
  set(program icome_${name}_tests)
  add_executable(${program})
  icome_sources(${program} ${sources})
  add_dependencies(icome_unit_tests ${program})
  # Checks that run once need no optimising: what they check is optimised as users have it.
  target_compile_options(${program} PRIVATE $<IF:$<BOOL:${ARG_COMPUTES}>,-O1,-O0>)
  target_link_libraries(${program} PRIVATE icome_${name} icome_places GTest::gtest_main ${ARG_LINKS})
  icome_unit_test(${name} ${program} ${ARG_SHARDS})
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
  add_executable(${program})
  icome_sources(${program} ${sources})
  if(NOT ICOME_OPTIMISE_BENCHMARKS)
    target_compile_options(${program} PRIVATE -O0)
  endif()
  target_link_libraries(${program} PRIVATE icome_base icome_places ${ARG_LINKS})
  set_property(GLOBAL APPEND PROPERTY ICOME_BENCHMARKS ${program})
endfunction()
