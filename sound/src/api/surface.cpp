#include "api/guard.h"
#include "api/ids.h"
#include "bridge/contact_sides.h"

#include <ode_sound/sound.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace ode::sound;

dSoundSurface dSoundSurfaceDefault(void) {
    const Texture texture;
    dSoundSurface out{};
    out.struct_size = sizeof out;
    out.roughness = texture.roughness;
    out.longest = texture.longest;
    out.shortest = texture.shortest;
    out.seed = texture.seed;
    out.loss = Skin{}.loss;
    return out;
}

int dSoundSetGeomSurface(dSoundWorldID world, dGeomID geom, const dSoundSurface* surface) {
    require_id(world, "dSoundSetGeomSurface");
    require_id(surface, "dSoundSetGeomSurface");
    return guarded("dSoundSetGeomSurface", 0, [&] {
        dSoundSurface own = dSoundSurfaceDefault();
        std::memcpy(&own, surface, std::min<std::size_t>(surface->struct_size, sizeof own));
        if (!(own.loss >= 0.0 && own.loss <= 1.0)) {
            dMessage(0, "dSoundSetGeomSurface: the loss factor is %g; give one from 0 to 1",
                     own.loss);
            return 0;
        }
        Skin skin{nullptr, own.loss};
        if (own.count != 0) {
            if (own.count < 2 || !own.profile || !(own.spacing > 0.0) ||
                !std::all_of(own.profile, own.profile + own.count,
                             [](dReal h) { return std::isfinite(h); })) {
                dMessage(0,
                         "dSoundSetGeomSurface: a profile of %d heights %g m apart is none; give "
                         "two finite ones or more, and a spacing above 0",
                         own.count, own.spacing);
                return 0;
            }
            const std::vector<double> height(own.profile, own.profile + own.count);
            skin.roughness = std::make_shared<const Roughness>(height, own.spacing);
        } else {
            if (!(own.roughness >= 0.0) || !std::isfinite(own.roughness) ||
                !(own.shortest > 0.0 && own.shortest < own.longest) ||
                !std::isfinite(own.longest)) {
                dMessage(0,
                         "dSoundSetGeomSurface: heights of %g m over wavelengths of %g to %g m; "
                         "give a roughness of 0 or more, and the shorter wavelength first",
                         own.roughness, own.shortest, own.longest);
                return 0;
            }
            skin.roughness = std::make_shared<const Roughness>(
                Texture{own.roughness, own.longest, own.shortest, own.seed});
        }
        world->world.rigid().geoms().set_skin(geom, skin);
        return 1;
    });
}
