/** @file
 * Owning C++ handles over <ode_softbody/softbody.h>: move-only, no logic. A handle converts to the
 * id that the C functions take, and is false when creation failed.
 */
#ifndef ODE_SOFTBODY_SOFTBODY_HPP
#define ODE_SOFTBODY_SOFTBODY_HPP

#include <ode_softbody/softbody.h>

#include <memory>
#include <type_traits>

namespace ode::soft {

/// Destroys an id with the C function it belongs to.
template <auto Destroy>
struct Destroyer {
    template <class Object>
    void operator()(Object* id) const noexcept {
        Destroy(id);
    }
};

/// Owner of an id.
template <class Id, auto Destroy>
class Handle : public std::unique_ptr<std::remove_pointer_t<Id>, Destroyer<Destroy>> {
public:
    using std::unique_ptr<std::remove_pointer_t<Id>, Destroyer<Destroy>>::unique_ptr;
    operator Id() const noexcept { return this->get(); }
};

using WorldHandle = Handle<dSoftWorldID, dSoftWorldDestroy>;
using MeshHandle = Handle<dSoftMeshID, dSoftMeshDestroy>;
using ModesHandle = Handle<dSoftModesID, dSoftModesDestroy>;
using BodyHandle = Handle<dSoftBodyID, dSoftBodyDestroy>;

} // namespace ode::soft

#endif
