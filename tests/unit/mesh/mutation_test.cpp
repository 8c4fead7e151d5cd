#include "base/error.h"
#include "mesh/quality.h"
#include "mesh/surface.h"
#include "shapes.h"
#include "writers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace ode::soft {
namespace {

// One to four changes of the kinds that damage files: a bit, a byte, a digit, a piece removed,
// doubled or overwritten by another.
void mutate(std::string& bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
        const std::size_t at = below(bytes.size());
        const std::size_t length = std::min(1 + below(24), bytes.size() - at);
        switch (below(6)) {
        case 0:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
            break;
        case 1:
            bytes[at] = static_cast<char>(below(256));
            break;
        case 2:
            bytes[at] = "0123456789-.e \n$"[below(16)];
            break;
        case 3:
            bytes.erase(at, length);
            break;
        case 4:
            bytes.insert(below(bytes.size()), bytes.substr(at, length));
            break;
        default:
            bytes.replace(below(bytes.size()), length, bytes.substr(at, length));
        }
    }
}

class Mutated : public testing::TestWithParam<test::Dress> {};
INSTANTIATE_TEST_SUITE_P(, Mutated, testing::ValuesIn(test::all_dresses()),
                         [](const testing::TestParamInfo<test::Dress>& dress) {
                             return dress.param.name;
                         });

// The short, repeatable sister of tests/fuzz: a damaged file is refused by name or gives a mesh
// that passes the checks; nothing else is thrown. Both must happen, or the test would prove
// nothing.
TEST_P(Mutated, FileIsRefusedOrGivesASoundMesh) {
    const std::string whole = GetParam().write(make_box({1, 1, 1}, 1, 2, 1));
    std::mt19937 random(20011);
    int refused = 0, accepted = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string bytes = whole;
        mutate(bytes, random);
        TetMesh mesh;
        try {
            mesh = GetParam().read(bytes, "mutant");
        } catch (const InputError& error) {
            ++refused;
            EXPECT_THAT(error.what(), testing::StartsWith("mutant"));
            continue;
        }
        ++accepted;
        EXPECT_NO_THROW(check_mesh(mesh, "mutant"));
        EXPECT_NO_THROW(extract_surface(mesh));
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(accepted, 40);
}

} // namespace
} // namespace ode::soft
