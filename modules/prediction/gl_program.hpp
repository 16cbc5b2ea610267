#pragma once

namespace ppm {

struct GlFunctions;

/// Compiles and links a vertex and a fragment shader. The context must be current. Throws Error with the driver's
/// words.
unsigned make_gl_program(const GlFunctions& gl, const char* vertex, const char* fragment);

}  // namespace ppm
