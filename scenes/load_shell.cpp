#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>

#include "scenes/data/raw.h"
#include "scenes/data/read_mesh.h"
#include "scenes/errors.h"
#include "scenes/make_shell.h"
#include "scenes/noise.h"
#include "scenes/scene_plan.h"

namespace volumark {
namespace {

// RGBA, four samples a texel. u8: colour and A in steps of 1/255; the emission is colour * A * extinction. f32: colours
// times A, and A, from 0 on. (Associated, as ShellTexture has them.)
ShellTexture read_texture(const FileSpec& spec, std::span<const std::byte> bytes, double extinction) {
  RawLayout layout = *spec.raw;
  layout.size.x *= 4;
  const Volume samples = read_raw(bytes, layout, NonFinite::Refuse, spec.file);
  ShellTexture texture;
  texture.size = spec.raw->size;
  for (int k = 0; k < texture.size.z; ++k) {
    for (int j = 0; j < texture.size.y; ++j) {
      for (int i = 0; i < texture.size.x; ++i) {
        glm::dvec4 texel;
        for (int c = 0; c < 4; ++c) texel[c] = samples.at(4 * i + c, j, k);
        if (layout.type == VoxelType::U8) {
          texel /= 255.0;
          texel = glm::dvec4(glm::dvec3(texel) * texel.a, texel.a);
        }
        texture.texels.emplace_back(texel * extinction);
      }
    }
  }
  return texture;
}

struct ThicknessOf {
  const Mesh& mesh;
  std::vector<double> operator()(double everywhere) const { return {everywhere}; }
  std::vector<double> operator()(const std::vector<double>& each) const { return each; }
  std::vector<double> operator()(const ShellSpec::Varying& varying) const {
    glm::dvec3 lo(mesh.positions.front()), hi(lo);
    for (const glm::dvec3& p : mesh.positions) {
      lo = glm::min(lo, p);
      hi = glm::max(hi, p);
    }
    const glm::dvec3 extent = hi - lo;
    const double longest = std::max({extent.x, extent.y, extent.z});
    const PerlinNoise noise(varying.seed);
    std::vector<double> out;
    for (const glm::dvec3& p : mesh.positions) {
      // Perlin's noise lies within 1 but mostly within .7: the range is used, and kept.
      const glm::dvec3 q = longest > 0 ? (p - lo) / longest : glm::dvec3(0);
      const double t = std::clamp(0.5 + 0.7 * noise(q * varying.frequency + 0.5), 0.0, 1.0);
      out.push_back(std::lerp(varying.least, varying.greatest, t));
    }
    return out;
  }
};

}  // namespace

Shell load_shell(const ShellSpec& spec, const ReadFile& read) {
  const auto* mesh_file = std::get_if<FileSpec>(&spec.mesh);
  const std::string what = mesh_file != nullptr ? mesh_file->file : "generated mesh";
  Mesh mesh =
      mesh_file != nullptr ? read_mesh(read(*mesh_file), mesh_file->file) : make_mesh(std::get<MeshSpec>(spec.mesh));
  check_mesh(mesh, what);
  if (spec.project) project_texture(mesh);
  const auto* texture_file = std::get_if<FileSpec>(&spec.texture);
  auto colours = std::make_shared<const ShellTexture>(
      texture_file != nullptr ? read_texture(*texture_file, read(*texture_file), spec.extinction)
                              : make_texture(std::get<TextureSpec>(spec.texture)));
  std::vector<double> thickness = std::visit(ThicknessOf{mesh}, spec.thickness);
  return make_shell(std::move(mesh), std::move(thickness), spec.repeat, std::move(colours), what);
}

}  // namespace volumark
