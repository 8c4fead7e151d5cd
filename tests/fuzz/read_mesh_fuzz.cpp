// Whatever the bytes are, a reader either refuses them with InputError or returns a mesh that has a
// surface and passes the checks. One program a format: FUZZ_READ is its reader.
#include "base/error.h"
#include "mesh/quality.h"
#include "mesh/surface.h"
#include "unit/mesh/writers.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace ode::soft;
    const std::string bytes(data, data + size);
    TetMesh mesh;
    try {
        mesh = FUZZ_READ(bytes, "fuzz");
    } catch (const InputError& error) {
        if (std::string_view(error.what()).find("fuzz") == std::string_view::npos)
            std::abort(); // the sentence must name the file
        return 0;
    }
    check_mesh(mesh, "fuzz");
    if (extract_surface(mesh).triangle.size() < 4)
        std::abort();
    return 0;
}
