#pragma once

#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

namespace ode::test {

/// Soft enough for a few hundred substeps a step; undamped.
inline dSoftSolid soft_rubber() {
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = 1e6;
    solid.poisson = 0.3;
    solid.density = 1000;
    solid.alpha = 0;
    solid.beta = 0;
    return solid;
}

/// A soft cube at z.
inline dSoftBodyID add_cube(dSoftWorldID world, dReal side, dReal z, int cells = 2) {
    const ode::soft::MeshHandle mesh(dSoftMeshCreateBox(side, side, side, cells, cells, cells));
    const dSoftSolid solid = soft_rubber();
    const dSoftBodyID body = dSoftBodyCreate(world, mesh, &solid);
    if (body)
        dSoftBodySetPosition(body, 0, 0, z);
    return body;
}

inline dReal height_of(dSoftBodyID body) {
    dVector3 center = {};
    dSoftBodyGetCenterOfMass(body, center);
    return center[2];
}

/// What ODE's message handler gets to hear while this lives; one at a time.
class Messages {
public:
    Messages() {
        all().clear();
        dSetMessageHandler([](int, const char* text, va_list arguments) {
            char line[1024];
            std::vsnprintf(line, sizeof line, text, arguments);
            all().emplace_back(line);
        });
    }
    ~Messages() { dSetMessageHandler(nullptr); }

    static std::vector<std::string>& all() {
        static std::vector<std::string> heard;
        return heard;
    }
    /// How many sentences hold these words.
    static int with(const std::string& words) {
        int count = 0;
        for (const std::string& sentence : all())
            count += sentence.find(words) != std::string::npos;
        return count;
    }
    static std::string text() {
        std::string joined;
        for (const std::string& sentence : all())
            joined += sentence + "\n";
        return joined;
    }
};

} // namespace ode::test
