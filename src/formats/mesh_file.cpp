// Reads polygon meshes, with Assimp, which is trusted in little: it reads no files but those near by, its exceptions and messages become
// an Error of one line, and what it hands over is checked before it is used.
#include "formats/mesh_file.h"

#include "formats/gltf_subdivision.h"
#include "formats/mesh_access.h"
#include "formats/mesh_notes.h"
#include "formats/mesh_ply.h"
#include "formats/mesh_scene.h"
#include "formats/obj_cage.h"
#include "formats/obj_file.h"
#include "formats/trial_run.h"
#include "scene/text.h"
#include "tessera/error.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cctype>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <system_error>

// Distributions build Assimp with its assertions, damaged files make some of them fail, and the library's own function for that ends the
// program. This one takes its place where the linker lets it (ELF without -Bsymbolic), and makes an exception of it.
namespace Assimp {

void aiAssertViolation(const char* failedExpression, const char* file, int line);

void aiAssertViolation(const char* failedExpression, const char* file, int line) {
    throw std::runtime_error(std::string(failedExpression) + " is not so in " + file + ", line " + std::to_string(line));
}

}  // namespace Assimp

namespace tessera {

namespace {

void checkFile(const std::filesystem::path& path, const MeshNotes& notes) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) notes.fail("cannot be found; check the name");
    if (std::filesystem::is_directory(status)) notes.fail("is a folder; name a mesh file in it");
    if (!std::filesystem::is_regular_file(status)) notes.fail("is no ordinary file; copy the mesh to one");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) notes.fail("its size cannot be read (" + error.message() + "); check its permissions");
    if (size == 0) notes.fail("is empty; give a file with a mesh");
    if (size > kLargestMeshFile) {
        notes.fail("has " + std::to_string(size) + " bytes; mesh files hold at most " + std::to_string(kLargestMeshFile));
    }
}

// Runs one of the importer's steps.
template <typename Step>
const aiScene& sceneOf(const Assimp::Importer& importer, const MeshNotes& notes, Step step) {
    const aiScene* scene = step();
    if (scene != nullptr) return *scene;
    const std::string reason = oneLine(importer.GetErrorString());
    notes.fail((reason.empty() ? "cannot be read as a mesh" : "cannot be read as a mesh: " + reason) +
               "; repair it, or convert it to OBJ, PLY or glTF");
}

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Some of what is in a file's head, before Assimp reads it.
void checkHead(MeshFolder& folder, const MeshNotes& notes) {
    constexpr std::size_t kLongestHead = std::size_t{1} << 20U;
    const std::unique_ptr<Assimp::IOStream> stream = folder.open(notes.file().c_str());
    if (stream == nullptr) notes.fail("cannot be opened; check its permissions");
    std::string head(std::min(kLongestHead, stream->FileSize()), '\0');
    head.resize(stream->Read(head.data(), 1, head.size()));
    const std::string ending = lowerCase(std::filesystem::path(notes.file()).extension().string());
    if (ending == ".ply" || lowerCase(head.substr(0, 3)) == "ply") checkPlyHeader(head, stream->FileSize(), notes);
}

void setUp(Assimp::Importer& importer, MeshFolder& folder) {
    importer.SetIOHandler(folder.makeAccess().release());  // owned by the importer from here on
    // Neither is drawn: no meshes made up of bones, no time spent on motion.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
}

// Some of Assimp's readers crash on damaged files, OFF's for one: a process of its own tries first.
void tryReading(MeshFolder& folder, std::uintmax_t fileBytes, const MeshNotes& notes) {
    constexpr unsigned kLeastSeconds = 60;
    checkHead(folder, notes);
    const auto seconds = kLeastSeconds + static_cast<unsigned>(fileBytes >> 20U);
    const std::string death = trialRun(
        [&] {
            Assimp::Importer importer;
            setUp(importer, folder);
            static_cast<void>(importer.ReadFile(notes.file(), aiProcess_Triangulate));
        },
        seconds);
    if (!death.empty()) {
        notes.fail("the reader of this format does not stand it: " + death + "; repair the file, or convert it to OBJ, PLY or glTF");
    }
}

Scene import(MeshFolder& folder, const MeshReading& reading, const MeshNotes& notes) {
    checkHead(folder, notes);
    Assimp::Importer importer;
    setUp(importer, folder);
    const aiScene* source = &sceneOf(importer, notes, [&] { return importer.ReadFile(notes.file(), 0); });
    // Cages beside triangles are rare and keep their polygons in glTF, which has no others.
    if (checkMeshScene(*source, notes) == MeshFaces::polygons && !reading.cages) {
        source = &sceneOf(importer, notes, [&] { return importer.ApplyPostProcessing(aiProcess_Triangulate); });
    }
    return makeMeshScene(*source, reading, notes);
}

std::string endingOf(const MeshNotes& notes) { return lowerCase(std::filesystem::path(notes.file()).extension().string()); }

// All of the file.
std::string readWhole(MeshFolder& folder, const MeshNotes& notes) {
    const std::unique_ptr<Assimp::IOStream> stream = folder.open(notes.file().c_str());
    if (stream == nullptr) notes.fail("cannot be opened; check its permissions");
    std::string text(stream->FileSize(), '\0');
    if (!text.empty() && stream->Read(text.data(), 1, text.size()) != text.size()) notes.fail("cannot be read to its end; check the disk");
    return text;
}

// What reads a file, and what it is asked for.
class FileReader {
public:
    FileReader(MeshFolder& folder, const MeshNotes& notes, bool trial) : folder_(folder), notes_(notes), trial_(trial) {}

    Scene triangles(bool flat) {
        return caught([&] { return assimp({flat, false, std::nullopt, nullptr}); });
    }

    Scene cages(std::optional<SubdivisionScheme> scheme) {
        return caught([&] {
            const std::string ending = endingOf(notes_);
            if (ending == ".obj") return objCages(scheme);
            if (ending == ".gltf" || ending == ".glb") return gltfCages(scheme);
            return assimp({false, scheme.has_value(), scheme, nullptr});
        });
    }

private:
    Scene objCages(std::optional<SubdivisionScheme> scheme) {
        const std::string text = readWhole(folder_, notes_);
        if (!scheme.has_value() && !hasObjTags(text)) return assimp({});
        return readObjCages(text, scheme.value_or(SubdivisionScheme::catmullClark), folder_, notes_);
    }

    Scene gltfCages(std::optional<SubdivisionScheme> scheme) {
        const GltfSubdivision subdivision(readWhole(folder_, notes_), notes_);
        if (subdivision.empty()) return assimp({false, scheme.has_value(), scheme, nullptr});
        folder_.replaceFile(std::as_bytes(std::span(subdivision.numbered())));
        return assimp({false, true, scheme, &subdivision});
    }

    Scene assimp(const MeshReading& reading) {
        if (trial_) tryReading(folder_, std::filesystem::file_size(notes_.file()), notes_);
        return import(folder_, reading, notes_);
    }

    // What both Assimp and memory may throw, and what is told and checked at the end.
    template <typename Read>
    Scene caught(Read read) {
        try {
            Scene scene = read();
            for (const std::string& refused : folder_.refused()) {
                notes_.warn("names the file " + quotedName(refused) + ", which is not in its folder: it is not read");
            }
            scene.validate();
            return scene;
        } catch (const Error&) {
            throw;
        } catch (const std::bad_alloc&) {
            notes_.fail("there is not enough memory to read it; split it into smaller files");
        } catch (const std::exception& exception) {
            notes_.fail("cannot be read as a mesh: " + oneLine(exception.what()) + "; repair it, or convert it to OBJ, PLY or glTF");
        }
    }

    MeshFolder& folder_;
    const MeshNotes& notes_;
    bool trial_;  // whether a process of its own tries Assimp first
};

template <typename Read>
Scene readPath(const std::filesystem::path& path, std::vector<std::string>* warnings, Read read) {
    const MeshNotes notes(path.string(), warnings);
    checkFile(path, notes);
    MeshFolder folder(path);
    return read(FileReader(folder, notes, true));
}

template <typename Read>
Scene readBytes(std::span<const std::byte> bytes, const std::string& fileName, std::vector<std::string>* warnings, Read read) {
    const MeshNotes notes(fileName, warnings);
    if (bytes.empty()) notes.fail("is empty; give a file with a mesh");
    MeshFolder folder(fileName, bytes);
    return read(FileReader(folder, notes, false));
}

}  // namespace

bool isMeshFile(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    return extension.size() > 1 && Assimp::Importer().IsExtensionSupported(extension);
}

Scene readMeshFile(const std::filesystem::path& path, bool flat, std::vector<std::string>* warnings) {
    return readPath(path, warnings, [&](FileReader reader) { return reader.triangles(flat); });
}

Scene parseMeshFile(std::span<const std::byte> bytes, const std::string& fileName, bool flat, std::vector<std::string>* warnings) {
    return readBytes(bytes, fileName, warnings, [&](FileReader reader) { return reader.triangles(flat); });
}

Scene readCageFile(const std::filesystem::path& path, std::optional<SubdivisionScheme> scheme, std::vector<std::string>* warnings) {
    return readPath(path, warnings, [&](FileReader reader) { return reader.cages(scheme); });
}

Scene parseCageFile(std::span<const std::byte> bytes, const std::string& fileName, std::optional<SubdivisionScheme> scheme,
                    std::vector<std::string>* warnings) {
    return readBytes(bytes, fileName, warnings, [&](FileReader reader) { return reader.cages(scheme); });
}

}  // namespace tessera
