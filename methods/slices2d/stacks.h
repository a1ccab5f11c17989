// The volume as three object-aligned stacks of slices in 2D textures (rezksalama2000, section 4), and which of them a
// view takes. No 3D texture is used.
//
// A stack is a few pages: large 2D textures that hold its slices as tiles, row by row. The paper binds a texture a
// slice; with pages a stack is one draw instead of hundreds, and a program reads any slice of the page. Each tile has
// a gutter of one texel that repeats its edge, so that bilinear filtering never reaches into the next tile.
//
// Neighbouring pages share two slices: whatever lies up to half a slice around a slice that is drawn lies in one page.
// Pages stay below kPageExtent where three slices fit: texture coordinates are floats, good to 2^-13 of a texel there.
//
// The stack's frame: local and box coordinates with the axes renamed in a circle, so that z runs across the slices.
// Every vector that a program gets is given in it, and one program draws all three stacks.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "backends/device.h"
#include "methods/volume/gradient_texels.h"
#include "methods/volume/volume_resources.h"

namespace volumark {

inline constexpr int kPageExtent = 4096;

// Stored slices [first, last] in one texture of columns x rows tiles.
struct StackPage {
  int first = 0, last = 0;
  int columns = 1, rows = 1;
};

struct StackLayout {
  int axis = 2;         // of the volume: 0 i, 1 j, 2 k
  glm::ivec2 slice{1};  // samples of one slice, in the stack's frame
  int slices = 1;       // stored ones
  std::vector<StackPage> pages;

  glm::ivec2 tile() const { return slice + 2; }
  glm::ivec2 extent(const StackPage& page) const { return {page.columns * tile().x, page.rows * tile().y}; }
  size_t texels() const;  // of all pages
};

// Nothing where not even three slices (or all that there are) fit into a texture of `limit` texels a side.
std::optional<StackLayout> stack_layout(const glm::ivec3& size, int axis, int limit);

// The texels of one page, with each tile's gutter, out of those of a volume of `size` (x fastest, `texel` bytes each).
std::vector<std::byte> page_texels(const StackLayout& layout, const StackPage& page, const glm::ivec3& size,
                                   std::span<const std::byte> texels, size_t texel);

// The frame of the stack of `axis`.
glm::dvec3 turned(const glm::dvec3& v, int axis);
Float4 turned(const Float4& v, int axis);  // w is kept
ViewRays turned(const ViewRays& rays, int axis);
VolumeUniforms turned(const VolumeUniforms& uniforms, int axis);

// The stack whose slices lie closest together along the view: largest |d_a| / spacing_a. With cubic voxels that is the
// one whose normal makes the smallest angle with the view; with others, thick slices are taken only where the view
// meets them steeply enough. d is the ray through the volume's middle, or the direction of view where the middle is not
// in the picture or the eye is inside the volume. Ties (to 1e-9): k before j before i, k being the order of storage.
int best_stack(const Volume& volume, const ViewRays& rays);

// What the stacks hold: the data, the gradients, or both in textures of their own (rezksalama2000, sections 7 and 8).
struct StackSettings {
  VolumeSettings volume;  // classification Post (scalars) or Pre (associated colours)
  bool data = true;       // false: no texture of the data
  // Gradients, with the axes of the stack's frame.
  std::optional<GradientSettings> gradient = std::nullopt;
  int slots = 1;  // textures that the program declares; where there are fewer, the last one is bound again
};

// The three stacks and the transfer table on a Device. Owns them; dies before the Device.
class SliceStacks {
 public:
  SliceStacks(const Scene& scene, const VolumeSettings& settings, Device& device)
      : SliceStacks(scene, StackSettings{settings}, device) {}
  SliceStacks(const Scene& scene, const StackSettings& settings, Device& device);
  ~SliceStacks();
  SliceStacks(const SliceStacks&) = delete;
  SliceStacks& operator=(const SliceStacks&) = delete;

  const StackLayout& layout(int axis) const { return stacks_[static_cast<size_t>(axis)].layout; }
  // The uniform block (0) and transfer table (2) of volume_common.glsl, and the textures of one page, from slot 4 on:
  // data (where there are any), then gradients.
  static std::vector<BindingDecl> declarations(int textures = 1);
  std::vector<Binding> bindings(int axis, int page, const Binding& uniforms) const;
  // Sets uniforms.value and uniforms.texel: a gradient is texel * x + y, z: 1 where it is a normal (stacks have no
  // other use for it). Call it behind turned().
  void fill(VolumeUniforms& uniforms) const;
  size_t texture_bytes() const { return texture_bytes_; }

 private:
  struct Stack {
    StackLayout layout;
    std::vector<std::vector<Texture>> pages;  // the textures of each
  };
  void add_data(const Scene& scene, const VolumeSettings& settings);
  void add_texture(const char* label, const glm::ivec3& size, Format format, std::span<const std::byte> texels,
                   bool vectors);
  Texture create(const TextureDesc& desc);
  void release();

  Device& device_;
  std::array<Stack, 3> stacks_;
  Texture transfer_;
  float value_origin_ = 0, value_scale_ = 1;
  float vector_scale_ = 1, vector_offset_ = 0;
  bool normals_ = false;
  int table_size_ = 0;
  int slots_ = 1;
  size_t texture_bytes_ = 0;
};

// Why these stacks cannot be had on `backend`; nothing where they can.
std::optional<std::string> stacks_unsupported(const Scene& scene, const VolumeSettings& settings,
                                              const BackendInfo& backend);

}  // namespace volumark
