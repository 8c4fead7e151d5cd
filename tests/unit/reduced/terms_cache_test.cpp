#include "reduced/terms_cache.h"

#include "mesh/generate.h"
#include "model/make_model.h"
#include "model/materials.h"
#include "support/soft_app.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace ode::soft {
namespace {

namespace fs = std::filesystem;
using test::Messages;

class TermsCache : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "terms_cache_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
        options_.mass = MassKind::kLumped;
        options_.estimate = false;
        options_.max_modes = 12;
        options_.max_frequency = 1e6;
        const auto model = make_model("stvk", mesh_, {&solid_, 1});
        mass_.assign(model->mass().begin(), model->mass().end());
    }
    void TearDown() override { fs::remove_all(directory_); }
    CubicTerms::Coefficients get() {
        return cached_terms(mesh_, {&solid_, 1}, options_, mass_, {5, 4, 8}, directory_);
    }
    fs::path file() const {
        for (const auto& entry : fs::directory_iterator(directory_))
            if (entry.path().extension() == ".cubic")
                return entry.path();
        return {};
    }
    static void expect_equal(const CubicTerms::Coefficients& a, const CubicTerms::Coefficients& b) {
        EXPECT_EQ(a.order.modes, b.order.modes);
        EXPECT_EQ(a.driven, b.driven);
        EXPECT_EQ(a.cubic, b.cubic);
        EXPECT_EQ(a.quartic, b.quartic);
        EXPECT_EQ(a.driving, b.driving);
        EXPECT_EQ(a.following, b.following);
        EXPECT_EQ(a.shape, b.shape);
        EXPECT_EQ(a.follow, b.follow);
    }

    Messages messages_;
    TetMesh mesh_ = make_bar(0.2, 0.02, 0.01, 5, 1, 1);
    Solid solid_ = find_material("steel")->solid;
    ModalOptions options_;
    std::vector<double> mass_;
    fs::path directory_;
};

TEST_F(TermsCache, GivesBackTheSame) {
    const CubicTerms::Coefficients made = get();
    ASSERT_FALSE(file().empty());
    ASSERT_EQ(made.order.modes, 5u);
    ASSERT_FALSE(made.follow.empty());
    const auto written = fs::last_write_time(file());
    expect_equal(get(), made);
    EXPECT_EQ(fs::last_write_time(file()), written);
    EXPECT_EQ(Messages::text(), "");
}

TEST_F(TermsCache, WhatIsDamagedOrCutShortIsToldAndMadeAnew) {
    const CubicTerms::Coefficients made = get();
    {
        std::fstream out(file(), std::ios::in | std::ios::out | std::ios::binary);
        out.seekp(-9, std::ios::end);
        out.put('x');
    }
    expect_equal(get(), made);
    EXPECT_EQ(Messages::with("is damaged"), 1) << Messages::text();
    Messages::all().clear();
    fs::resize_file(file(), 100);
    expect_equal(get(), made);
    EXPECT_EQ(Messages::with("is damaged"), 1) << Messages::text();
    Messages::all().clear();
    expect_equal(get(), made);
    EXPECT_EQ(Messages::text(), "");
}

} // namespace
} // namespace ode::soft
