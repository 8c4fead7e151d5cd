#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "api/versioned.h"

#include <cmath>
#include <string_view>

using namespace ode::soft;

namespace {

dSoftContact to_c(const ContactLaw& law) noexcept {
    dSoftContact contact{};
    contact.struct_size = sizeof contact;
    contact.friction = law.friction;
    contact.stiffness = law.stiffness;
    contact.damping = law.damping;
    return contact;
}

/// @throws InputError
ContactLaw from_c(const dSoftContact& contact) {
    dSoftContact c = dSoftContactDefault();
    copy_in(contact, "dSoftContactDefault", &c);
    if (!(c.friction >= 0 && c.stiffness >= 0 && c.damping >= 0 && std::isfinite(c.stiffness) &&
          std::isfinite(c.damping)))
        throw InputError(format("friction %g, stiffness %g Pa/m or damping %g s is negative or not "
                                "a number; give values of at least 0",
                                c.friction, c.stiffness, c.damping));
    return {c.friction, c.stiffness, c.damping};
}

/// The application's callback as a ContactChooser.
class CallbackChooser {
public:
    CallbackChooser(dSoftContactCallback* callback, void* data) noexcept
        : callback_(callback), data_(data) {}

    bool operator()(Body& soft, dGeomID rigid, ContactLaw& law) noexcept {
        dSoftContact contact = to_c(law);
        if (!callback_(data_, soft.geom(), rigid, &contact))
            return false;
        try {
            law = from_c(contact);
        } catch (const InputError& e) {
            if (!complained_)
                report(format("the contact callback's %s; the soft body's own contact holds",
                              e.what()));
            complained_ = true;
        }
        return true;
    }

private:
    dSoftContactCallback* callback_;
    void* data_;
    bool complained_ = false;
};

constexpr struct {
    const char* name;
    SoftContactMethod method;
} kMethods[] = {{"closest-point", SoftContactMethod::closest_point},
                {"volume", SoftContactMethod::volume}};

} // namespace

int dSoftWorldSetSoftContactMethod(dSoftWorldID id, const char* name) {
    require_id(name, __func__);
    SoftWorld* world = live(id, __func__);
    if (!world || !may_edit(*world, __func__))
        return 0;
    for (const auto& known : kMethods)
        if (std::string_view(name) == known.name) {
            world->set_soft_contact_method(known.method);
            return 1;
        }
    report(format("%s: there is no method '%s'; give 'closest-point' or 'volume'", __func__, name));
    return 0;
}

const char* dSoftWorldGetSoftContactMethod(dSoftWorldID id) {
    const SoftWorld* world = live(id, __func__);
    if (!world)
        return nullptr;
    for (const auto& known : kMethods)
        if (world->soft_contact_method() == known.method)
            return known.name;
    return nullptr;
}

dSoftContact dSoftContactDefault(void) { return to_c(ContactLaw{}); }

void dSoftBodySetSelfContact(dSoftBodyID id, int on) {
    if (Body* body = live(id, __func__))
        body->set_self_contact(on != 0);
}

int dSoftBodyGetSelfContact(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    return body && body->self_contact();
}

int dSoftBodySetContact(dSoftBodyID id, const dSoftContact* contact) {
    require_id(contact, __func__);
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    return guarded(__func__, 0, [&] {
        body->set_contact_law(from_c(*contact));
        return 1;
    });
}

int dSoftWorldSetContactCallback(dSoftWorldID id, dSoftContactCallback* callback, void* data) {
    SoftWorld* world = live(id, __func__);
    if (!world)
        return 0;
    return guarded(__func__, 0, [&] {
        world->set_contact_chooser(callback ? ContactChooser(CallbackChooser(callback, data))
                                            : ContactChooser());
        return 1;
    });
}
