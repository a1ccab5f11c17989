// The OpenGL 4.5 functions that the backend calls, loaded from a context: neither libGL nor libOSMesa is linked.
#pragma once

#include <GL/glcorearb.h>

namespace volumark {

class GlContext;

// Typedef of <GL/glcorearb.h>, and the name without "gl".
#define VM_GL_FUNCTIONS(X)                                             \
  X(PFNGLATTACHSHADERPROC, AttachShader)                               \
  X(PFNGLBINDBUFFERPROC, BindBuffer)                                   \
  X(PFNGLBINDBUFFERRANGEPROC, BindBufferRange)                         \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                         \
  X(PFNGLBINDIMAGETEXTUREPROC, BindImageTexture)                       \
  X(PFNGLBINDSAMPLERPROC, BindSampler)                                 \
  X(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                         \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                         \
  X(PFNGLBINDVERTEXBUFFERPROC, BindVertexBuffer)                       \
  X(PFNGLBLENDFUNCPROC, BlendFunc)                                     \
  X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus) \
  X(PFNGLCLAMPCOLORPROC, ClampColor)                                   \
  X(PFNGLCLEARNAMEDBUFFERDATAPROC, ClearNamedBufferData)               \
  X(PFNGLCLEARNAMEDFRAMEBUFFERFIPROC, ClearNamedFramebufferfi)         \
  X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)         \
  X(PFNGLCLEARTEXIMAGEPROC, ClearTexImage)                             \
  X(PFNGLCLIPCONTROLPROC, ClipControl)                                 \
  X(PFNGLCOLORMASKPROC, ColorMask)                                     \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                             \
  X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                             \
  X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                   \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                             \
  X(PFNGLCREATEQUERIESPROC, CreateQueries)                             \
  X(PFNGLCREATESAMPLERSPROC, CreateSamplers)                           \
  X(PFNGLCREATESHADERPROC, CreateShader)                               \
  X(PFNGLCREATETEXTURESPROC, CreateTextures)                           \
  X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                   \
  X(PFNGLCULLFACEPROC, CullFace)                                       \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                             \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                   \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                             \
  X(PFNGLDELETEQUERIESPROC, DeleteQueries)                             \
  X(PFNGLDELETESAMPLERSPROC, DeleteSamplers)                           \
  X(PFNGLDELETESHADERPROC, DeleteShader)                               \
  X(PFNGLDELETETEXTURESPROC, DeleteTextures)                           \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                   \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                                     \
  X(PFNGLDEPTHMASKPROC, DepthMask)                                     \
  X(PFNGLDISABLEPROC, Disable)                                         \
  X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                         \
  X(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced)                 \
  X(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced)             \
  X(PFNGLENABLEPROC, Enable)                                           \
  X(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)         \
  X(PFNGLFINISHPROC, Finish)                                           \
  X(PFNGLFRONTFACEPROC, FrontFace)                                     \
  X(PFNGLGETERRORPROC, GetError)                                       \
  X(PFNGLGETINTEGER64VPROC, GetInteger64v)                             \
  X(PFNGLGETINTEGERI_VPROC, GetIntegeri_v)                             \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                                 \
  X(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)             \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                     \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                               \
  X(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)                 \
  X(PFNGLGETQUERYIVPROC, GetQueryiv)                                   \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                       \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                                 \
  X(PFNGLGETSTRINGPROC, GetString)                                     \
  X(PFNGLGETTEXLEVELPARAMETERIVPROC, GetTexLevelParameteriv)           \
  X(PFNGLGETTEXTURESUBIMAGEPROC, GetTextureSubImage)                   \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                 \
  X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                             \
  X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                   \
  X(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                   \
  X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)         \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                                 \
  X(PFNGLPROVOKINGVERTEXPROC, ProvokingVertex)                         \
  X(PFNGLQUERYCOUNTERPROC, QueryCounter)                               \
  X(PFNGLSAMPLERPARAMETERFVPROC, SamplerParameterfv)                   \
  X(PFNGLSAMPLERPARAMETERIPROC, SamplerParameteri)                     \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                               \
  X(PFNGLSTENCILFUNCSEPARATEPROC, StencilFuncSeparate)                 \
  X(PFNGLSTENCILMASKPROC, StencilMask)                                 \
  X(PFNGLSTENCILOPSEPARATEPROC, StencilOpSeparate)                     \
  X(PFNGLTEXIMAGE1DPROC, TexImage1D)                                   \
  X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                   \
  X(PFNGLTEXIMAGE3DPROC, TexImage3D)                                   \
  X(PFNGLTEXTURESTORAGE1DPROC, TextureStorage1D)                       \
  X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                       \
  X(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)                       \
  X(PFNGLTEXTURESUBIMAGE1DPROC, TextureSubImage1D)                     \
  X(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                     \
  X(PFNGLTEXTURESUBIMAGE3DPROC, TextureSubImage3D)                     \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                   \
  X(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding)       \
  X(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat)         \
  X(PFNGLVERTEXARRAYBINDINGDIVISORPROC, VertexArrayBindingDivisor)     \
  X(PFNGLVIEWPORTPROC, Viewport)

struct GlFunctions {
#define VM_GL_MEMBER(type, name) type name = nullptr;
  VM_GL_FUNCTIONS(VM_GL_MEMBER)
#undef VM_GL_MEMBER
};

// The context must be current. Throws DeviceError MissingCapability with the name of a function that is not there.
GlFunctions load_gl_functions(const GlContext& context);

}  // namespace volumark
