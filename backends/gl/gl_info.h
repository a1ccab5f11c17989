// What the driver is and can do.
#pragma once

#include "backends/gl/gl_context.h"
#include "backends/gl/gl_functions.h"
#include "backends/types.h"

namespace volumark {

// Sets, where the user has not, the environment that drivers read when the first context is made.
void set_driver_environment();

// The context must be current.
BackendInfo query_gl_info(const GlFunctions& gl, const GlContext& context);

}  // namespace volumark
