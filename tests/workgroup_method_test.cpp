// PoCL's work-group methods turn kernels with barriers into loops in different ways: the pictures must have the same bits.
#include "run_program.h"

#include "tessera/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace tessera::test {
namespace {

bool defaultDeviceIsPocl() {
    for (const DeviceInfo& device : listDevices()) {
        if (device.isDefault) return device.platform.find("Portable Computing Language") != std::string::npos;
    }
    return false;
}

// Each method with caches of its own, empty before: a compiled kernel does not say how it was made.
Outcome bitsUnder(const std::string& method) {
    const ScratchFolder caches;
    const std::string folder = caches.path().string();
    std::filesystem::create_directories(folder + "/pocl");
    return RunningProgram(
               PICTURE_BITS_PATH, {}, caches.path(),
               {{"POCL_WORK_GROUP_METHOD", method}, {"POCL_CACHE_DIR", folder + "/pocl"}, {"TESSERA_CACHE", folder + "/tessera"}})
        .wait();
}

TEST(WorkGroupMethods, GiveTheSameBits) {
    if (!defaultDeviceIsPocl()) GTEST_SKIP() << "the default device is not PoCL's";
    const Outcome vectorized = bitsUnder("loopvec");
    const Outcome looped = bitsUnder("loops");
    ASSERT_EQ(vectorized.exitCode, 0) << vectorized.err;
    ASSERT_EQ(looped.exitCode, 0) << looped.err;
    // Three scenes in both modes and four in watertight mode alone, three sets of options, both kinds of atomics, six planes and a count
    // each.
    EXPECT_EQ(std::count(vectorized.out.begin(), vectorized.out.end(), '\n'), (3 * 2 + 4) * 3 * 2 * 7);
    EXPECT_EQ(vectorized.out, looped.out);
}

}  // namespace
}  // namespace tessera::test
