// Image files are read back with OpenImageIO: what writeImage() promises of each format.
#include "image_samples.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace tessera {
namespace {

using Window = std::array<int, 4>;  // x, y, width, height
Window dataWindow(const OIIO::ImageSpec& spec) { return {spec.x, spec.y, spec.width, spec.height}; }
Window displayWindow(const OIIO::ImageSpec& spec) { return {spec.full_x, spec.full_y, spec.full_width, spec.full_height}; }

std::vector<std::uint32_t> readIds(const fs::path& path, const std::string& channel) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) return {};
    const int index = input->spec().channelindex(channel);
    std::vector<std::uint32_t> ids(input->spec().image_pixels());
    EXPECT_TRUE(input->read_image(0, 0, index, index + 1, OIIO::TypeUInt32, ids.data())) << input->geterror();
    return ids;
}

// sRGB as IEC 61966-2-1 states it, in double precision.
double srgb(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055; }

// Largest distance between a file's 8-bit value and the formula: half a step, and a little for single precision.
constexpr double halfStep = 0.5 / 255.0 + 1e-5;

TEST_F(ImageFile, ExrHoldsEveryPlaneInItsOwnType) {
    TestFrame test = gradient(7, 5);
    test.add("Z", 1, test.z, 0.37F);
    test.add("N", 3, test.n, 0.001F);
    test.add("object.id", 1, test.object, 1.0F);
    test.add("patch.id", 1, test.patch, 1000.0F);
    test.add("uv", 2, test.uv, 0.01F);
    test.z[3] = std::numeric_limits<float>::infinity();
    test.object[3] = test.patch[3] = -1.0F;
    test.patch[4] = 16777216.0F;
    writeImage(file("a.exr"), test.frame, {});

    const Picture picture = readPicture(file("a.exr"));
    for (const char* name : {"R", "G", "B", "A"}) EXPECT_EQ(picture.type(name), OIIO::TypeHalf) << name;
    for (const char* name : {"Z", "N.X", "N.Y", "N.Z", "u", "v"}) EXPECT_EQ(picture.type(name), OIIO::TypeFloat) << name;
    for (const char* name : {"object.id", "patch.id"}) EXPECT_EQ(picture.type(name), OIIO::TypeUInt32) << name;
    EXPECT_EQ(picture.spec.nchannels, 12);

    const std::vector<std::uint32_t> objects = readIds(file("a.exr"), "object.id");
    const std::vector<std::uint32_t> patches = readIds(file("a.exr"), "patch.id");
    for (std::size_t i = 0; i < test.pixels(); ++i) {
        const int x = static_cast<int>(i) % 7;
        const int y = static_cast<int>(i) / 7;
        const std::array colour{"R", "G", "B", "A"};
        for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(picture.at(x, y, colour[c]), test.rgba[i * 4 + c], 1.0 / 2048.0);
        EXPECT_EQ(picture.at(x, y, "Z"), test.z[i]);
        const std::array normal{"N.X", "N.Y", "N.Z"};
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(picture.at(x, y, normal[c]), test.n[i * 3 + c]);
        EXPECT_EQ(picture.at(x, y, "u"), test.uv[i * 2]);
        EXPECT_EQ(picture.at(x, y, "v"), test.uv[i * 2 + 1]);
        const auto number = static_cast<std::uint32_t>(i);
        EXPECT_EQ(objects[i], i == 3 ? 4294967295U : number);
        EXPECT_EQ(patches[i], i == 3 ? 4294967295U : i == 4 ? 16777216U : number * 1000U);
    }
}

TEST_F(ImageFile, ExrHasColourOnlyWhenTheFrameHas) {
    writeImage(file("a.exr"), gradient(3, 2).frame, {});
    EXPECT_EQ(readPicture(file("a.exr")).spec.channelnames, (std::vector<std::string>{"R", "G", "B", "A"}));
}

TEST_F(ImageFile, ExrColourBeyondHalfIsClampedToTheLargest) {
    TestFrame test(2, 1);
    test.rgba = {1e6F, -1e6F, 65519.0F, 1.0F, std::numeric_limits<float>::infinity(), 65504.0F, 0.5F, 1.0F};
    test.frame.planes[0].values = test.rgba;
    writeImage(file("a.exr"), test.frame, {});
    EXPECT_EQ(readPicture(file("a.exr")).values, (std::vector<float>{65504.0F, -65504.0F, 65504.0F, 1.0F, 65504.0F, 65504.0F, 0.5F, 1.0F}));
}

TEST_F(ImageFile, ExrWindowsAreTheCropAndTheFullPicture) {
    TestFrame test = gradient(5, 4);
    test.frame.x0 = 20;
    test.frame.y0 = 10;
    test.frame.fullWidth = 64;
    test.frame.fullHeight = 32;
    writeImage(file("a.exr"), test.frame, {});
    const Picture picture = readPicture(file("a.exr"));
    EXPECT_EQ(dataWindow(picture.spec), (Window{20, 10, 5, 4}));
    EXPECT_EQ(displayWindow(picture.spec), (Window{0, 0, 64, 32}));
    EXPECT_NEAR(picture.at(4, 3, "R"), test.rgba[76], 1.0 / 2048.0);

    for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
        writeImage(file(name), test.frame, {});
        const Picture display = readPicture(file(name));
        EXPECT_EQ(dataWindow(display.spec), (Window{0, 0, 5, 4})) << name;
        EXPECT_EQ(displayWindow(display.spec), (Window{0, 0, 5, 4})) << name;
    }
}

TEST_F(ImageFile, ExrOfManyRowsKeepsTheirOrder) {
    TestFrame test = gradient(3, 1000);
    test.add("Z", 1, test.z, 1.0F);
    writeImage(file("a.exr"), test.frame, {});
    const Picture picture = readPicture(file("a.exr"));
    for (int y = 0; y < 1000; ++y) ASSERT_EQ(picture.at(2, y, "Z"), static_cast<float>(y * 3 + 2));
}

TEST_F(ImageFile, ExrMetadataHasMatricesOptionsAndStatistics) {
    TestFrame test = gradient(2, 2);
    Statistics& statistics = test.frame.statistics;
    statistics.device = "pocl";
    statistics.method = "bounded";
    statistics.batch = 40000;
    statistics.rangesProcessed = 22172;
    statistics.micropolygons = 5000000000;
    statistics.stackPeak = 2147483648;
    statistics.frameMs = 12.25;
    statistics.kernelMs["dice"] = 3.5;
    ImageMetadata metadata;
    metadata.command = "tessera render teapot";
    metadata.options = {{"split-bound", "8"}, {"crop", "0,1,0,1"}};
    // A camera at (1, 2, 3) that looks along -z: what is 10 before it has depth 10.
    metadata.worldToCamera[3] = glm::vec4(-1.0F, -2.0F, -3.0F, 1.0F);
    metadata.worldToScreen[2] = glm::vec4(0.25F, 0.5F, 0.75F, -1.0F);
    writeImage(file("a.exr"), test.frame, metadata);

    const OIIO::ImageSpec spec = readPicture(file("a.exr")).spec;
    EXPECT_EQ(spec.get_string_attribute("Software"), "Tessera " + std::string(versionString()));
    EXPECT_EQ(spec.get_string_attribute("ImageDescription"), "tessera render teapot");
    EXPECT_EQ(spec.get_string_attribute("tessera:split-bound"), "8");
    EXPECT_EQ(spec.get_string_attribute("tessera:crop"), "0,1,0,1");
    EXPECT_EQ(spec.get_string_attribute("tessera:device"), "pocl");
    EXPECT_EQ(spec.get_string_attribute("tessera:method"), "bounded");
    EXPECT_EQ(spec.get_int_attribute("tessera:batch"), 40000);
    EXPECT_EQ(spec.get_int_attribute("tessera:ranges_processed"), 22172);
    EXPECT_EQ(spec.get_string_attribute("tessera:micropolygons"), "5000000000");
    EXPECT_EQ(spec.get_string_attribute("tessera:stack_peak"), "2147483648");
    EXPECT_EQ(spec.get_float_attribute("tessera:frame_ms"), 12.25F);
    EXPECT_EQ(spec.get_float_attribute("tessera:kernel_ms:dice"), 3.5F);
    for (const char* name : {"ranges_diced", "ranges_culled", "iterations", "batches", "patches", "pixels_covered", "device_bytes_peak",
                             "width", "height", "pixel_samples", "split_ms", "build_ms"}) {
        EXPECT_NE(spec.find_attribute(std::string("tessera:") + name), nullptr) << name;
    }

    // OpenEXR: row vectors times a matrix of rows; x right, y up, z forward.
    std::array<float, 16> camera{};
    std::array<float, 16> screen{};
    ASSERT_TRUE(spec.getattribute("worldtocamera", OIIO::TypeMatrix, camera.data()));
    ASSERT_TRUE(spec.getattribute("worldToNDC", OIIO::TypeMatrix, screen.data()));
    const std::array point{1.0F, 2.0F, -7.0F, 1.0F};
    std::array<float, 4> seen{};
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) seen[j] += point[i] * camera[i * 4 + j];
    }
    EXPECT_EQ(seen, (std::array{0.0F, 0.0F, 10.0F, 1.0F}));
    EXPECT_EQ((std::array{screen[8], screen[9], screen[10], screen[11]}), (std::array{0.25F, 0.5F, 0.75F, -1.0F}));
}

TEST_F(ImageFile, PngAndTiffAreUnassociatedSrgbOfTheLinearColour) {
    const TestFrame test = gradient(33, 31);
    for (const char* name : {"a.png", "a.tif", "a.TIFF"}) {
        writeImage(file(name), test.frame, {});
        const Picture picture = readPicture(file(name));
        ASSERT_EQ(picture.spec.channelnames, (std::vector<std::string>{"R", "G", "B", "A"})) << name;
        EXPECT_EQ(picture.spec.format, OIIO::TypeUInt8) << name;
        for (std::size_t i = 0; i < test.rgba.size(); i += 4) {
            const double alpha = test.rgba[i + 3];
            ASSERT_NEAR(picture.values[i + 3], alpha, halfStep) << name;
            for (std::size_t c = 0; c < 3; ++c) {
                const double wanted = alpha > 0.0 ? srgb(test.rgba[i + c] / alpha) : 0.0;
                ASSERT_NEAR(picture.values[i + c], wanted, halfStep) << name << " pixel " << i / 4 << " channel " << c;
            }
        }
    }
}

TEST_F(ImageFile, PngAndJpegSayThatTheyAreSrgb) {
    for (const char* name : {"a.png", "a.jpg"}) {
        writeImage(file(name), gradient(3, 3).frame, {});
        EXPECT_EQ(readPicture(file(name)).spec.get_string_attribute("oiio:ColorSpace"), "sRGB") << name;
    }
}

TEST_F(ImageFile, TiffSaysThatItsAlphaIsUnassociated) {
    writeImage(file("a.tif"), gradient(3, 3).frame, {});
    const auto input = OIIO::ImageInput::open(file("a.tif").string());
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().get_int_attribute("tiff:UnassociatedAlpha") + input->spec().get_int_attribute("oiio:UnassociatedAlpha"), 1);
}

TEST_F(ImageFile, DisplayFormatsClampWhatTheyCannotShow) {
    TestFrame test(4, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    test.rgba = {7.0F, -1.0F, nan, 1.0F, 1.0F, 1.0F, 1.0F, 1.5F, 0.5F, 0.5F, 0.5F, 0.0F, 0.5F, 0.25F, 0.125F, 0.5F};
    test.frame.planes[0].values = test.rgba;
    writeImage(file("a.png"), test.frame, {});
    const std::vector<float> values = readPicture(file("a.png")).values;
    EXPECT_EQ(std::vector(values.begin(), values.begin() + 4), (std::vector{1.0F, 0.0F, 0.0F, 1.0F}));
    EXPECT_EQ(values[7], 1.0F);
    EXPECT_EQ(std::vector(values.begin() + 8, values.begin() + 12), (std::vector{0.0F, 0.0F, 0.0F, 0.0F}));
    EXPECT_EQ(values[12], 1.0F);
}

TEST_F(ImageFile, JpegShowsThePictureOverBlack) {
    TestFrame test(32, 32);
    for (std::size_t i = 0; i < test.rgba.size(); i += 4) {
        const float alpha = i < test.rgba.size() / 2 ? 0.5F : 1.0F;
        test.rgba[i] = 0.8F * alpha;
        test.rgba[i + 1] = 0.2F * alpha;
        test.rgba[i + 2] = 0.05F * alpha;
        test.rgba[i + 3] = alpha;
    }
    for (const char* name : {"a.jpg", "a.JPEG"}) {
        writeImage(file(name), test.frame, {});
        const Picture picture = readPicture(file(name));
        ASSERT_EQ(picture.spec.channelnames, (std::vector<std::string>{"R", "G", "B"})) << name;
        for (const int y : {4, 28}) {
            const double alpha = y < 16 ? 0.5 : 1.0;
            EXPECT_NEAR(picture.at(16, y, "R"), srgb(0.8 * alpha), 0.015) << name << y;
            EXPECT_NEAR(picture.at(16, y, "G"), srgb(0.2 * alpha), 0.015) << name << y;
            EXPECT_NEAR(picture.at(16, y, "B"), srgb(0.05 * alpha), 0.015) << name << y;
        }
    }
}

TEST_F(ImageFile, EqualPicturesAreEqualFilesWhateverTheCommandAndTheDate) {
    const TestFrame test = gradient(9, 9);
    ImageMetadata other;
    other.command = "another command";
    other.options["batch"] = "7";
    for (const std::string ending : {".png", ".tif", ".jpg"}) {
        writeImage(file("a" + ending), test.frame, {});
        writeImage(file("b" + ending), test.frame, other);
        EXPECT_TRUE(bytesOf(file("a" + ending)) == bytesOf(file("b" + ending))) << ending;
    }
    writeImage(file("a.exr"), test.frame, {});
    for (const std::string ending : {".png", ".tif", ".jpg", ".exr"}) {
        const std::string date = readPicture(file("a" + ending)).spec.get_string_attribute("DateTime");
        EXPECT_TRUE(date.empty() || date == "1970:01:01 00:00:00") << ending << " " << date;
    }
}

}  // namespace
}  // namespace tessera
