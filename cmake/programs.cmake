# vm_programs(TARGET FILES a.vert b.frag ... [COMMON header.glsl ...])
# Every program is `#version 450` + backends/common.glsl + the COMMON files + its own text. It is compiled to SPIR-V here
# (an error fails the build) and embedded, text and SPIR-V, as `extern const volumark::ShaderText NAME_STAGE;` declared in
# "programs/NAME_STAGE.h", in namespace volumark::programs (texture3d_slices.frag -> texture3d_slices_frag).
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)

function(vm_programs target)
  cmake_parse_arguments(A "" "" "FILES;COMMON" ${ARGN})
  set(out ${CMAKE_BINARY_DIR}/generated/programs)
  file(MAKE_DIRECTORY ${out})
  foreach(file ${A_FILES})
    get_filename_component(base ${file} NAME_WE)
    get_filename_component(ext ${file} LAST_EXT)
    string(SUBSTRING ${ext} 1 -1 stage)
    set(name ${base}_${stage})
    set(parts ${VM_ROOT}/backends/common.glsl)
    foreach(common ${A_COMMON})
      get_filename_component(path ${common} ABSOLUTE)
      list(APPEND parts ${path})
    endforeach()
    get_filename_component(path ${file} ABSOLUTE)
    list(APPEND parts ${path})
    add_custom_command(
      OUTPUT ${out}/${name}.cpp ${out}/${name}.h
      COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DSTAGE=${stage} -DOUT=${out} "-DPARTS=${parts}"
              -DVALIDATOR=${GLSLANG_VALIDATOR} -P ${VM_ROOT}/cmake/embed_program.cmake
      DEPENDS ${parts} ${VM_ROOT}/cmake/embed_program.cmake
      COMMENT "GLSL ${name}"
      VERBATIM)
    target_sources(${target} PRIVATE ${out}/${name}.cpp ${out}/${name}.h)
  endforeach()
endfunction()
