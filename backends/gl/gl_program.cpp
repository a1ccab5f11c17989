#include "backends/gl/gl_program.h"

#include <string_view>

#include "backends/device.h"

namespace volumark {

namespace {

bool declares_constant(std::string_view text, std::string_view name) {
  constexpr std::string_view kMacro = "VM_SPEC(";
  constexpr std::string_view kBlank = " \t\n";
  for (size_t at = text.find(kMacro); at != text.npos; at = text.find(kMacro, at + 1)) {
    const size_t comma = text.find(',', at);
    if (comma == text.npos) return false;
    const size_t begin = text.find_first_not_of(kBlank, comma + 1);
    const size_t end = text.find_first_of(", \t\n)", begin);
    if (begin != text.npos && text.substr(begin, end - begin) == name) return true;
  }
  return false;
}

GLenum gl_stage(Stage stage) {
  switch (stage) {
    case Stage::Vertex:
      return GL_VERTEX_SHADER;
    case Stage::Geometry:
      return GL_GEOMETRY_SHADER;
    case Stage::Fragment:
      return GL_FRAGMENT_SHADER;
    case Stage::Compute:
      return GL_COMPUTE_SHADER;
  }
  return GL_NONE;
}

const char* stage_name(Stage stage) {
  switch (stage) {
    case Stage::Vertex:
      return "vertex";
    case Stage::Geometry:
      return "geometry";
    case Stage::Fragment:
      return "fragment";
    case Stage::Compute:
      return "compute";
  }
  return "unknown";
}

// `get` and `log` are the functions of a shader or of a program.
template <class Get, class Log>
std::string info_log(Get get, Log log, GLuint object) {
  GLint length = 0;
  get(object, GL_INFO_LOG_LENGTH, &length);
  std::string text(static_cast<size_t>(length > 0 ? length : 0), '\0');
  GLsizei written = 0;
  if (!text.empty()) log(object, length, &written, text.data());
  text.resize(static_cast<size_t>(written));
  text.erase(text.find_last_not_of(" \n") + 1);
  return text;
}

GLuint compile_stage(const GlFunctions& gl, const ProgramDesc& desc, const ShaderText& stage) {
  const std::string text = specialise_glsl(stage, desc.constants);
  const GLuint shader = gl.CreateShader(gl_stage(stage.stage));
  const char* source = text.c_str();
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint ok = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return shader;
  const std::string log = info_log(gl.GetShaderiv, gl.GetShaderInfoLog, shader);
  gl.DeleteShader(shader);
  throw DeviceError(DeviceErrorKind::CompileFailed, "create_program", desc.label,
                    std::string(stage_name(stage.stage)) + " stage '" + (stage.name ? stage.name : "") + "': " + log);
}

}  // namespace

std::string specialise_glsl(const ShaderText& stage, const std::vector<SpecConstant>& constants) {
  const std::string_view text = stage.glsl ? stage.glsl : "";
  const size_t version_end = text.starts_with("#version") ? text.find('\n') : text.npos;
  const size_t body = version_end == text.npos ? 0 : version_end + 1;
  std::string result(text.substr(0, body));
  for (const SpecConstant& constant : constants) {
    if (!declares_constant(text, constant.name)) continue;
    result += "const int " + constant.name + " = " + std::to_string(constant.value) + ";\n";
  }
  result += body == 0 ? "#line 1\n" : "#line 2\n";
  result += text.substr(body);
  return result;
}

GLuint link_program(const GlFunctions& gl, const ProgramDesc& desc) {
  const GLuint program = gl.CreateProgram();
  try {
    for (const ShaderText* stage : desc.stages) {
      const GLuint shader = compile_stage(gl, desc, *stage);
      gl.AttachShader(program, shader);
      gl.DeleteShader(shader);  // lives as long as the program that it is attached to
    }
    gl.LinkProgram(program);
    GLint ok = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok == GL_TRUE) return program;
    throw DeviceError(DeviceErrorKind::CompileFailed, "create_program", desc.label,
                      "link: " + info_log(gl.GetProgramiv, gl.GetProgramInfoLog, program));
  } catch (...) {
    gl.DeleteProgram(program);
    throw;
  }
}

}  // namespace volumark
