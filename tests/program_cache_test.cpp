// The cache of built programs (src/device/program_cache.h), on a program of its own.
#include "device/program_cache.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tessera/error.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

class ProgramCache : public ::testing::Test {
protected:
    void SetUp() override {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] BuildRequest request(int value, const std::string& options = "") const {
        return {"kernel void fill(global int* out) { out[0] = " + std::to_string(value) + "; }", options, folder_};
    }

    // What a program's kernel writes.
    [[nodiscard]] int run(const cl::Program& program) const {
        const cl::Buffer out(device_.context, CL_MEM_READ_WRITE, sizeof(int));
        cl::Kernel kernel(program, "fill");
        kernel.setArg(0, out);
        int value = 0;
        device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
        device_.queue.enqueueReadBuffer(out, CL_TRUE, 0, sizeof value, &value);
        return value;
    }

    [[nodiscard]] std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
        return found;
    }

    const OpenDevice device_ = openDevice(-1);
    const fs::path folder_ = fs::temp_directory_path() / ("tessera_cache_" + std::to_string(::getpid()));
};

TEST_F(ProgramCache, LoadsWhatItStored) {
    EXPECT_EQ(run(buildProgram(device_, request(7))), 7);
    ASSERT_EQ(files().size(), 1U);
    const auto written = fs::last_write_time(files().front());
    EXPECT_EQ(run(buildProgram(device_, request(7))), 7);
    ASSERT_EQ(files().size(), 1U);
    EXPECT_EQ(fs::last_write_time(files().front()), written);
}

TEST_F(ProgramCache, TellsSourcesAndOptionsApart) {
    EXPECT_EQ(run(buildProgram(device_, request(1))), 1);
    EXPECT_EQ(run(buildProgram(device_, request(2))), 2);
    EXPECT_EQ(run(buildProgram(device_, request(2, "-DUNUSED=1"))), 2);
    EXPECT_EQ(files().size(), 3U);
}

TEST_F(ProgramCache, BuildsAnewWhereAFileIsDamaged) {
    EXPECT_EQ(run(buildProgram(device_, request(3))), 3);
    for (const std::string& damage : {std::string(), std::string("not a program"), std::string(100000, '\0')}) {
        std::ofstream(files().front(), std::ios::binary | std::ios::trunc) << damage;
        EXPECT_EQ(run(buildProgram(device_, request(3))), 3) << damage.size() << " bytes";
        EXPECT_EQ(files().size(), 1U);
    }
}

TEST_F(ProgramCache, DoesWithoutAFolderItCannotWrite) {
    BuildRequest unwritable = request(4);
    unwritable.cacheFolder = "/proc/no/such/folder";
    EXPECT_EQ(run(buildProgram(device_, unwritable)), 4);
    unwritable.cacheFolder.clear();
    EXPECT_EQ(run(buildProgram(device_, unwritable)), 4);
}

TEST_F(ProgramCache, ReportsABuildErrorInOneLine) {
    const BuildRequest broken{"kernel void fill(global int* out) { out[0] = nothing; }", "", folder_};
    try {
        static_cast<void>(buildProgram(device_, broken));
        FAIL() << "a broken kernel was built";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("nothing"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(files().empty());
}

TEST(ProgramCachePolicy, LeavesPoclToItsOwnCache) {
    DeviceInfo info;
    info.platform = "Portable Computing Language";
    EXPECT_TRUE(keepsOwnCache(info));
    info.platform = "NVIDIA CUDA";
    EXPECT_FALSE(keepsOwnCache(info));
}

}  // namespace
}  // namespace tessera
