# The language, the warnings and the floating-point policy of every target, in one place.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

find_program(CCACHE ccache)
if(CCACHE)
  # A base folder and no folder in the hash: a clone elsewhere finds the objects of this one.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE})
  set(CMAKE_CUDA_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()

find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Threads REQUIRED)

# What every library of ours compiles with. Contraction is off so that every instruction set gives the same bits.
add_library(windfall_options INTERFACE)
target_compile_options(windfall_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wno-missing-field-initializers
    -ffp-contract=off -fno-math-errno -fpch-preprocess $<$<BOOL:${WINDFALL_WERROR}>:-Werror>>)
target_include_directories(windfall_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
if(WINDFALL_SANITIZE)
  target_compile_options(windfall_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${WINDFALL_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all -Wno-maybe-uninitialized>)  # GCC 12 sees ghosts in std::regex
  target_link_options(windfall_options INTERFACE -fsanitize=${WINDFALL_SANITIZE})
endif()

# windfall_library(NAME [LIBRARIES ...] [PCH ...]): the static library of the folder it is called in.
# Sources are found by name, so a new tool, importer or exporter is one new file.
function(windfall_library name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;PCH;EXCLUDE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.h *.cpp)
  foreach(pattern IN LISTS ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${CMAKE_CURRENT_SOURCE_DIR}/${pattern}")
  endforeach()
  add_library(${name} STATIC ${sources})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(${name} PUBLIC windfall_options ${ARG_LIBRARIES})
  if(ARG_PCH)
    target_precompile_headers(${name} PRIVATE ${ARG_PCH})
  endif()
endfunction()
