#include "transfer/table_cache.h"

#include "unit/transfer/shapes.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

namespace ode::sound::test {
namespace {

namespace fs = std::filesystem;

template <class T>
void expect_same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0);
}

class TableCacheTest : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "table_cache_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        cache_.directory = name;
        cache_.tell = [this](const std::string& sentence) { heard_ += sentence; };
        surface_.mesh = sphere(1);
        for (const double f : {100.0, 900.0}) {
            surface_.frequency.push_back(f);
            for (const Vec3& x : surface_.mesh.node)
                for (int c = 0; c < 3; ++c)
                    surface_.shape.push_back(f < 500 ? x[c] : c == 2 ? 1.0 : 0.0);
        }
    }
    void TearDown() override { fs::remove_all(cache_.directory); }

    TransferTable get() {
        made_ = false;
        return cache_.get(surface_, rule_, [this] {
            made_ = true;
            return make_transfer_table(surface_);
        });
    }
    fs::path file() const { return cache_.directory / TableCache::name(surface_, rule_); }
    static void expect_equal(const TransferTable& a, const TransferTable& b) {
        EXPECT_EQ(a.centre, b.centre);
        EXPECT_EQ(a.radius, b.radius);
        EXPECT_EQ(a.speed, b.speed);
        EXPECT_EQ(a.boundary_limit, b.boundary_limit);
        EXPECT_EQ(a.triangles, b.triangles);
        ASSERT_EQ(a.mode.size(), b.mode.size());
        for (std::size_t m = 0; m < a.mode.size(); ++m) {
            EXPECT_EQ(a.mode[m].frequency, b.mode[m].frequency);
            EXPECT_EQ(a.mode[m].order, b.mode[m].order);
            EXPECT_EQ(a.mode[m].first, b.mode[m].first);
            EXPECT_EQ(a.mode[m].first_degree, b.mode[m].first_degree);
        }
        expect_same_bits(a.coefficient, b.coefficient);
        expect_same_bits(a.per_sphere, b.per_sphere);
    }

    ModalSurface surface_;
    std::string rule_ = "transfer 1.21 343";
    TableCache cache_;
    std::string heard_;
    bool made_ = false;
};

TEST_F(TableCacheTest, GivesBackTheSameBitsWithoutMakingThem) {
    const TransferTable first = get();
    EXPECT_TRUE(made_);
    const TransferTable second = get();
    EXPECT_FALSE(made_);
    expect_equal(first, second);
    expect_equal(second, make_transfer_table(surface_));
    EXPECT_EQ(heard_, "");
    EXPECT_EQ(std::distance(fs::directory_iterator(cache_.directory), {}), 1); // no litter
}

TEST_F(TableCacheTest, NoticesAnyChangeOfWhatDecidesATable) {
    std::vector<std::string> seen = {TableCache::name(surface_, rule_)};
    const auto expect_new = [&](const char* what) {
        const std::string name = TableCache::name(surface_, rule_);
        for (const std::string& old : seen)
            EXPECT_NE(name, old) << what;
        seen.push_back(name);
    };
    surface_.mesh.node[3].x() = std::nextafter(surface_.mesh.node[3].x(), 2.0);
    expect_new("a node's last bit");
    std::swap(surface_.mesh.triangle[0], surface_.mesh.triangle[1]);
    expect_new("triangles");
    surface_.frequency[1] = std::nextafter(surface_.frequency[1], 1e9);
    expect_new("a frequency's last bit");
    surface_.shape.back() = -surface_.shape.back();
    expect_new("a shape");
    rule_ = "transfer 1.21 340";
    expect_new("the air");
}

TEST_F(TableCacheTest, MakesAnewWhatIsNoGoodAndSaysSo) {
    const TransferTable good = get();
    const auto size = fs::file_size(file());
    const auto spoil = [&](auto edit, const char* says) {
        heard_.clear();
        edit();
        const TransferTable again = get();
        EXPECT_TRUE(made_) << says;
        expect_equal(again, good);
        EXPECT_NE(heard_.find(says), std::string::npos) << heard_;
        get();
        EXPECT_FALSE(made_) << "the good file must be back";
    };
    const auto overwrite = [&](std::size_t at, char value) {
        std::fstream f(file(), std::ios::in | std::ios::out | std::ios::binary);
        f.seekp(static_cast<std::streamoff>(at));
        f.put(value);
    };
    spoil([&] { overwrite(size - 20, '\x55'); }, "is damaged");
    spoil([&] { fs::resize_file(file(), size / 2); }, "is damaged");
    spoil([&] { fs::resize_file(file(), 3); }, "cut short");
    spoil([&] { overwrite(0, 'x'); }, "is no table of radiation");
    spoil([&] { overwrite(8, 99); }, "version 99");
    // A file of another body under this one's name.
    spoil(
        [&] {
            ModalSurface other = surface_;
            other.frequency[0] = 101.0;
            cache_.get(other, rule_, [&] { return make_transfer_table(other); });
            fs::rename(cache_.directory / TableCache::name(other, rule_), file());
        },
        "is of another body");
}

TEST_F(TableCacheTest, DoesWithoutADirectory) {
    cache_.directory.clear();
    const TransferTable none = get();
    EXPECT_TRUE(made_);
    char name[] = "/tmp/table_cache_file_XXXXXX";
    close(mkstemp(name));
    cache_.directory = fs::path(name) / "below";
    expect_equal(get(), none);
    EXPECT_TRUE(made_);
    EXPECT_NE(heard_.find("can't be written"), std::string::npos) << heard_;
    fs::remove(name);
}

} // namespace
} // namespace ode::sound::test
