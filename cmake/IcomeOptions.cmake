# Language level, warnings, sanitizers, the compiler cache and where things are put: the same for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

option(ICOME_BUILD_TESTS "Build the tests" ON)
option(ICOME_BUILD_BENCHMARKS "Build the benchmarks" OFF)
option(ICOME_OPTIMISE_BENCHMARKS "Optimise the benchmarks' own sources; off where they are compiled but not run" ON)
option(ICOME_WARNINGS_AS_ERRORS "A compiler warning fails the build (what `make test` asks for)" OFF)
set(ICOME_BATCH 0 CACHE STRING "How many sources one compiler run takes at most; 0: each by itself")
option(ICOME_CHECK_NAMES "Names, and what else .clang-tidy asks for, are checked while compiling (clang only)" OFF)
set(ICOME_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, such as address,undefined")

# The cache is shared by every clone on the machine: paths count from the source tree, and the
# directory that a compiler runs in is not part of what it made.
set(in_cache CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1)
if(ICOME_CHECK_NAMES)
  # Another table or plug-in is another name, so that all is compiled again. The compiler cache goes by what the
  # plug-in is made of, as each clone makes it anew.
  set(names_by ${PROJECT_SOURCE_DIR}/.clang-tidy ${PROJECT_SOURCE_DIR}/tools/names_plugin.cpp)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${names_by})
  set(hashes "")
  foreach(file IN LISTS names_by)
    file(SHA1 ${file} hash)
    string(APPEND hashes ${hash})
  endforeach()
  string(SHA1 hash "${hashes}")
  string(SUBSTRING ${hash} 0 8 hash)
  set(plugin ${PROJECT_BINARY_DIR}/names_plugin_${hash}.so)
  if(NOT EXISTS ${plugin})
    message(STATUS "Making the plug-in that checks names")
    execute_process(COMMAND ${PROJECT_SOURCE_DIR}/tools/check-names --make-plugin ${plugin} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  add_compile_options(-fplugin=${plugin})
  string(REPLACE ";" ":" names_by "${names_by}")
  list(APPEND in_cache CCACHE_IGNOREOPTIONS=-fplugin=* CCACHE_EXTRAFILES=${names_by})
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER env ${in_cache} ${CCACHE_PROGRAM})
endif()

add_compile_options(-Wall -Wextra -Wshadow -Wno-psabi)
if(ICOME_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()
# Sources that are compiled several at a time are included by a generated one, so GCC takes them for headers and
# warns of members that others could not see: there are no others.
if(ICOME_BATCH AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-Wno-subobject-linkage)
endif()
# Clang warns of locals that have the name of a constant in another source of the batch.
if(ICOME_BATCH AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  add_compile_options(-Wno-shadow)
endif()
# A batch is compiled in less time (0.92 times) where GCC looks for memory to free only beyond 1 GB, kB here.
if(ICOME_BATCH AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("SHELL:--param ggc-min-heapsize=1000000")
endif()
# Equal inputs give equal bits whatever the optimiser does (replays are compared bit for bit).
add_compile_options(-ffp-contract=off)
# Where assert() is on, the containers of the standard library check their arguments too.
add_compile_definitions($<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)
if(ICOME_SANITIZE)
  add_compile_options(-fsanitize=${ICOME_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  # A null or misaligned access faults by itself, a wrong vptr is rare, and where an address that lies outside its
  # object is read or written the address sanitizer tells: checking each for every access would double the time that
  # compiling takes.
  add_compile_options(-fno-sanitize=null,alignment,vptr,object-size,pointer-overflow)
  # For code that sanitizers get in the way of, by the same names whatever the compiler.
  if(ICOME_SANITIZE MATCHES "address")
    add_compile_definitions(ICOME_ADDRESS_SANITIZER)
    # Stacks that outlive their functions, so that clang tells uses after a return, slow all calls down.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
      add_compile_options(-fsanitize-address-use-after-return=never)
    endif()
  endif()
  if(ICOME_SANITIZE MATCHES "thread")
    add_compile_definitions(ICOME_THREAD_SANITIZER)
  endif()
  # GCC's manual warns that sanitizers make it take values for uninitialised that are not; the release build tells.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
  add_link_options(-fsanitize=${ICOME_SANITIZE})
endif()

# The linker that takes the least time, where it is installed.
find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
  add_link_options(-fuse-ld=mold)
endif()

find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(tl-expected REQUIRED)
find_package(fmt REQUIRED)
