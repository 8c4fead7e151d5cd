#include "modal/cache.h"

#include "mesh/generate.h"

#include <gtest/gtest.h>

#include <ode/error.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <thread>

namespace ode::soft {
namespace {

namespace fs = std::filesystem;

std::string heard;
void hear(int, const char* text, va_list arguments) {
    char line[1024];
    std::vsnprintf(line, sizeof line, text, arguments);
    heard += line;
}

class Cache : public testing::Test {
protected:
    void SetUp() override {
        heard.clear();
        dSetMessageHandler(hear);
        std::string name = (fs::temp_directory_path() / "modal_cache_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
        options_.order = 2;
        options_.estimate = false;
        options_.progress = [this](const ModalProgress&) { return computed_ = true; };
    }
    void TearDown() override {
        dSetMessageHandler(nullptr);
        fs::remove_all(directory_);
    }
    ModalModel get() {
        computed_ = false;
        return cached_modes(mesh_, std::span(&solid_, 1), options_, directory_);
    }
    fs::path file() const {
        return directory_ / (content_hash(mesh_, std::span(&solid_, 1), options_) + ".modes");
    }
    static void expect_equal(const ModalModel& a, const ModalModel& b) {
        EXPECT_EQ(a.frequency, b.frequency);
        EXPECT_EQ(a.error_cents, b.error_cents);
        EXPECT_EQ(a.shape, b.shape);
        EXPECT_EQ(a.node_count, b.node_count);
        EXPECT_EQ(a.rigid_modes, b.rigid_modes);
        EXPECT_EQ(a.complete, b.complete);
        EXPECT_EQ(a.body.mass, b.body.mass);
        EXPECT_EQ(a.body.inertia, b.body.inertia);
    }

    TetMesh mesh_ = make_bar(0.2, 0.02, 0.01, 5, 1, 1);
    Solid solid_{.young = 200e9, .poisson = 0.29, .density = 7850};
    ModalOptions options_;
    fs::path directory_;
    bool computed_ = false;
};

TEST_F(Cache, GivesBackTheSameModelWithoutComputing) {
    const ModalModel first = get();
    EXPECT_TRUE(computed_);
    const ModalModel second = get();
    EXPECT_FALSE(computed_);
    expect_equal(first, second);
    EXPECT_EQ(heard, "");
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 1); // no litter
}

TEST_F(Cache, NoticesAnyChangeOfWhatDecidesTheModel) {
    const auto hash = [this] { return content_hash(mesh_, std::span(&solid_, 1), options_); };
    std::vector<std::string> seen{hash()};
    const auto expect_new = [&](const char* what) {
        for (const std::string& s : seen)
            EXPECT_NE(hash(), s) << what;
        seen.push_back(hash());
    };
    mesh_.node[3].x() = std::nextafter(mesh_.node[3].x(), 1.0);
    expect_new("a node's last bit");
    solid_.density += 1;
    expect_new("density");
    options_.order = 1;
    expect_new("order");
    options_.mass = MassKind::kLumped;
    expect_new("mass");
    options_.clamped = {1};
    expect_new("clamp");
    options_.clamped.clear();
    options_.rollers[0] = {1};
    expect_new("roller x");
    options_.rollers[0].clear();
    options_.rollers[1] = {1};
    expect_new("roller y");
    options_.max_frequency = 100;
    expect_new("range");
    mesh_.group.assign(mesh_.element_count(), 0);
    expect_new("groups");
    solid_.beta = 1; // damping isn't part of undamped modes
    EXPECT_EQ(hash(), seen.back());
}

TEST_F(Cache, ComputesAnewWhatIsDamagedAndSaysSo) {
    const ModalModel good = get();
    const auto size = fs::file_size(file());
    const auto damage = [&](auto edit, const char* says) {
        heard.clear();
        edit();
        const ModalModel again = get();
        EXPECT_TRUE(computed_) << says;
        expect_equal(again, good);
        EXPECT_NE(heard.find(says), std::string::npos) << heard;
        get();
        EXPECT_FALSE(computed_) << "the good file must be back";
    };
    const auto overwrite = [&](std::size_t at, char value) {
        std::fstream f(file(), std::ios::in | std::ios::out | std::ios::binary);
        f.seekp(static_cast<std::streamoff>(at));
        f.put(value);
    };
    damage([&] { overwrite(size - 100, 'x'); }, "is damaged");
    damage([&] { overwrite(18, 'x'); }, "cut short"); // the number of modes
    damage([&] { fs::resize_file(file(), size / 2); }, "cut short");
    damage([&] { fs::resize_file(file(), 0); }, "is not a modal model");
    damage([&] { overwrite(8, 99); }, "version 99");
    damage([&] { overwrite(0, 'x'); }, "is not a modal model");
}

TEST_F(Cache, SurvivesTwoWritersAtOnce) {
    options_.progress = {};
    std::vector<std::thread> threads;
    std::vector<ModalModel> models(4);
    for (ModalModel& m : models)
        threads.emplace_back(
            [&] { m = cached_modes(mesh_, std::span(&solid_, 1), options_, directory_); });
    for (std::thread& t : threads)
        t.join();
    for (const ModalModel& m : models)
        expect_equal(m, models[0]);
    expect_equal(get(), models[0]);
    EXPECT_EQ(heard, "");
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 1);
}

// Processes share no lock: four start at once on an empty cache, on one with a damaged file, and on
// a good one. Each gets the whole model, and one good file is left.
TEST_F(Cache, IsSafeBetweenProcesses) {
    options_.progress = {};
    const ModalModel expected = solve_modes(mesh_, std::span(&solid_, 1), options_);
    for (const char* start : {"empty", "damaged", "good"}) {
        if (std::string(start) == "damaged")
            fs::resize_file(file(), fs::file_size(file()) / 2);
        int gate[2];
        ASSERT_EQ(pipe(gate), 0);
        std::vector<pid_t> children;
        for (int n = 0; n < 4; ++n) {
            const pid_t child = fork();
            ASSERT_GE(child, 0);
            if (child == 0) {
                dSetMessageHandler([](int, const char*, va_list) {});
                close(gate[1]);
                char byte;
                (void)!read(gate[0], &byte, 1); // until the parent opens it to all
                const ModalModel got =
                    cached_modes(mesh_, std::span(&solid_, 1), options_, directory_);
                _exit(got.frequency == expected.frequency && got.shape == expected.shape ? 0 : 1);
            }
            children.push_back(child);
        }
        close(gate[0]);
        close(gate[1]);
        for (const pid_t child : children) {
            int status = -1;
            EXPECT_EQ(waitpid(child, &status, 0), child);
            EXPECT_EQ(status, 0) << start;
        }
        EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 1) << start;
        heard.clear();
        expect_equal(get(), expected);
        EXPECT_EQ(heard, "") << start << ": the file that is left must be good";
    }
}

TEST_F(Cache, DoesWithoutADirectoryThatCannotBeWritten) {
    const fs::path blocked = directory_ / "file";
    std::ofstream(blocked) << "not a directory";
    const ModalModel model =
        cached_modes(mesh_, std::span(&solid_, 1), options_, blocked / "below");
    EXPECT_GT(model.mode_count(), 0u);
    EXPECT_NE(heard.find("can't be written"), std::string::npos) << heard;
}

TEST_F(Cache, LivesWhereTheEnvironmentSays) {
    const auto set = [](const char* name, const char* value) { setenv(name, value, 1); };
    set("ODE_SOFTBODY_CACHE", "/a");
    set("XDG_CACHE_HOME", "/b");
    set("HOME", "/c");
    EXPECT_EQ(cache_directory(), "/a");
    set("ODE_SOFTBODY_CACHE", "");
    EXPECT_EQ(cache_directory(), "");
    unsetenv("ODE_SOFTBODY_CACHE");
    EXPECT_EQ(cache_directory(), "/b/ode_softbody");
    set("XDG_CACHE_HOME", "");
    EXPECT_EQ(cache_directory(), "/c/.cache/ode_softbody");
}

} // namespace
} // namespace ode::soft
