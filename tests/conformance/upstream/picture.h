#pragma once

#include "fingerprint.h"

namespace ode::conformance {

/// What a demo has drawn so far: every call and every number in it.
struct Picture {
    Fingerprint print;
    unsigned long calls = 0;
};
Picture& picture() noexcept;

} // namespace ode::conformance
