// What writeImage() and checkImagePath() refuse, and what they leave behind when they do.
#include "image_samples.h"
#include "small_files.h"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace tessera {
namespace {

TEST_F(ImageFile, UnknownEndingsAreRefusedWithTheListOfKnownOnes) {
    for (const char* name : {"a.bmp", "a", "a.png.gz", ".png", "png"}) {
        const std::string check = errorOf([&] { checkImagePath(file(name)); });
        EXPECT_NE(check.find(name), std::string::npos) << check;
        EXPECT_NE(check.find(".exr .png .tif .tiff .jpg .jpeg"), std::string::npos) << check;
        EXPECT_EQ(check, errorOf([&] { writeImage(file(name), gradient(2, 2).frame, {}); }));
    }
    EXPECT_TRUE(files().empty());
}

TEST_F(ImageFile, PathsThatCannotBeWrittenAreRefusedBeforeAndAtWriting) {
    fs::create_directories(file("folder.png"));
    std::ofstream(file("plain")) << "x";
    const std::vector<std::pair<fs::path, std::string>> cases{
        {file("folder.png"), "is a folder"},          {file("missing") / "a.png", "no such folder"},
        {file("plain") / "a.png", "is not a folder"}, {file(std::string(300, 'a') + ".png"), "shorter name"},
        {"/proc/tessera.png", "another folder"},
    };
    for (const auto& item : cases) {
        const fs::path& path = item.first;
        const std::string check = errorOf([&] { checkImagePath(path); });
        EXPECT_NE(check.find(item.second), std::string::npos) << check;
        EXPECT_EQ(check.find('\n'), std::string::npos) << check;
        EXPECT_EQ(check, errorOf([&] { writeImage(path, gradient(2, 2).frame, {}); }));
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"folder.png", "plain"}));
}

TEST_F(ImageFile, CheckingLeavesNothingBehindAndAnOldFileAlone) {
    std::ofstream(file("a.png")) << "old";
    checkImagePath(file("a.png"));
    checkImagePath(file("b.exr"));
    EXPECT_EQ(files(), std::vector<std::string>{"a.png"});
    EXPECT_EQ(bytesOf(file("a.png")), "old");
}

TEST_F(ImageFile, WritingReplacesAnOldFileAndHonoursTheUmask) {
    std::ofstream(file("a.png")) << "old";
    const mode_t before = ::umask(027);
    writeImage(file("a.png"), gradient(2, 2).frame, {});
    ::umask(before);
    EXPECT_EQ(files(), std::vector<std::string>{"a.png"});
    EXPECT_EQ(fs::status(file("a.png")).permissions(), static_cast<fs::perms>(0640));
    EXPECT_EQ(readPicture(file("a.png")).spec.width, 2);
}

TEST_F(ImageFile, AFailedWriteLeavesNoTemporaryAndTheOldFile) {
    std::string message;
    for (const char* name : {"a.exr", "a.png", "a.tif", "a.jpg"}) {
        std::ofstream(file(name)) << "old";
        {
            const test::SmallFiles limit(300);
            message = errorOf([&] { writeImage(file(name), gradient(40, 40).frame, {}); });
        }
        EXPECT_NE(message.find(name), std::string::npos) << message;
        EXPECT_NE(message.find("File too large"), std::string::npos) << message;
        EXPECT_EQ(bytesOf(file(name)), "old");
        fs::remove(file(name));
        EXPECT_TRUE(files().empty());
    }
}

TEST_F(ImageFile, PicturesThatAFormatCannotHoldAreRefused) {
    const std::string message = errorOf([&] { writeImage(file("a.jpg"), TestFrame(70000, 1).frame, {}); });
    EXPECT_NE(message.find("a.jpg"), std::string::npos) << message;
    EXPECT_NE(message.find("65500"), std::string::npos) << message;
    EXPECT_TRUE(files().empty());
}

TEST_F(ImageFile, FramesWithoutPixelsOrWithPlanesOfAnotherSizeAreRefused) {
    Frame empty;
    TestFrame wrong(4, 4);
    wrong.frame.height = 5;
    TestFrame noColour(2, 2);
    noColour.frame.planes[0].name = "Z";
    for (const Frame* frame : {&std::as_const(empty), &std::as_const(wrong.frame), &std::as_const(noColour.frame)}) {
        EXPECT_THROW(writeImage(file("a.exr"), *frame, {}), Error);
    }
    EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace tessera
