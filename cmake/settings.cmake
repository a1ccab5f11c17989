# Language, warnings and the one function that declares a library of the house.
get_filename_component(VM_ROOT ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(VM_CCACHE ccache)
if(VM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${VM_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${VM_CCACHE})
endif()

find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)

add_library(vm_settings INTERFACE)
target_include_directories(vm_settings INTERFACE ${VM_ROOT} ${CMAKE_BINARY_DIR}/generated)
target_compile_options(vm_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
                                             -Woverloaded-virtual
                                             # descriptors are written with designated initialisers
                                             -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(vm_settings INTERFACE -Wno-restrict)  # false alarm on "text" + std::string (GCC bug 105651)
endif()
if(VM_WERROR)
  target_compile_options(vm_settings INTERFACE -Werror)
endif()
# The order of floating-point operations is part of what is tested: no -ffast-math, and no fused multiply-add that the
# source does not ask for.
target_compile_options(vm_settings INTERFACE -ffp-contract=off)

# vm_library(name SOURCES ... LINK ...): a static library of ours, header paths from the top of the tree.
function(vm_library name)
  cmake_parse_arguments(A "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(${name} STATIC ${A_SOURCES})
  target_link_libraries(${name} PUBLIC vm_settings ${A_LINK} PRIVATE ${A_PRIVATE_LINK})
endfunction()

set(VM_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, comma separated")
if(VM_SANITIZE)
  target_compile_options(vm_settings INTERFACE -fsanitize=${VM_SANITIZE} -fno-omit-frame-pointer
                                               -fno-sanitize-recover=undefined)
  target_link_options(vm_settings INTERFACE -fsanitize=${VM_SANITIZE})
endif()
option(VM_COVERAGE "Instrument for gcov" OFF)
if(VM_COVERAGE)
  target_compile_options(vm_settings INTERFACE --coverage)
  target_link_options(vm_settings INTERFACE --coverage)
endif()
