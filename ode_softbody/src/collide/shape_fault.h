#pragma once

#include <ode/common.h>

#include <string>

namespace ode::soft {

/// Why no soft body can meet a rigid geom, as the end of a sentence about it; empty for a geom that
/// is all right and for kinds that never bear contact. Looks at size, pose and the body's motion.
std::string shape_fault(dGeomID geom);

/// "sphere 0x5581...", for messages.
std::string geom_name(dGeomID geom);

/// The cheap question behind shape_fault().
bool shape_is_sound(dGeomID geom) noexcept;

} // namespace ode::soft
