# Run by vm_programs: concatenates PARTS, compiles them, writes OUT/NAME.cpp and OUT/NAME.h.
set(text "#version 450\n")
foreach(part ${PARTS})
  file(READ ${part} body)
  string(APPEND text "${body}\n")
endforeach()
set(source ${OUT}/${NAME}.${STAGE})
file(WRITE ${source} "${text}")
execute_process(
  COMMAND ${VALIDATOR} -V --target-env vulkan1.3 --quiet -S ${STAGE} --vn spirv -o ${OUT}/${NAME}.spv.inc ${source}
  RESULT_VARIABLE result OUTPUT_VARIABLE log ERROR_VARIABLE log)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${NAME}: glslangValidator\n${log}\nfrom: ${PARTS}")
endif()
set(stage_vert Vertex)
set(stage_geom Geometry)
set(stage_frag Fragment)
set(stage_comp Compute)
# String literals are limited to 64 KiB by the standard: split at every 8,000 characters.
string(LENGTH "${text}" length)
set(literal "")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 8000 chunk)
  string(APPEND literal "R\"glsl(${chunk})glsl\"\n")
  math(EXPR at "${at} + 8000")
endwhile()
file(WRITE ${OUT}/${NAME}.cpp "#include \"programs/${NAME}.h\"
namespace {
#include \"programs/${NAME}.spv.inc\"
constexpr const char* kText =
${literal};
}  // namespace
namespace volumark::programs {
const ShaderText ${NAME}{\"${NAME}\", Stage::${stage_${STAGE}}, kText, spirv};
}
")
file(WRITE ${OUT}/${NAME}.h "#pragma once
#include \"backends/types.h\"
namespace volumark::programs {
extern const ShaderText ${NAME};
}
")
