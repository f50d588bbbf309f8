#include "proto/scene_loader.h"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <filesystem>
#include <iostream>
#include <iterator>
#include <new>

#include "proto/scene_translation.h"
#include "renderengine/error.h"
#include "renderengine/io/files.h"
#include "renderengine/io/text.h"
#include "scene/import_model.h"
#include "scene/precision_notices.h"
#include "scene/readable_names.h"

namespace antipode {
namespace {

/// Keeps the first error; what follows it is mostly its echo.
class FirstError : public google::protobuf::io::ErrorCollector {
public:
    explicit FirstError(std::string file) : file_(std::move(file)) {}

    void AddError(int line, int column, const std::string& message) override {
        // Protobuf counts from 0 and says −1 where it does not know.
        if (!text_.empty()) return;
        text_ = file_;
        if (line >= 0)
            text_.append(":").append(std::to_string(line + 1)).append(":").append(std::to_string(column + 1));
        text_.append(": ").append(readableText(message));
    }
    const std::string& text() const { return text_; }

private:
    std::string file_, text_;
};

void changeImported(const SceneChanges& changes, Scene& scene, const std::string& path) {
    try {
        changeScene(changes, scene);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::Usage) throw;
        throw Error(e.code(), path + ": " + readableText(e.what()));
    }
}

}  // namespace

Scene parseScene(const std::string& text, const std::string& name, const std::string& directory,
                 const ImportOptions& options, const SceneChanges& changes) {
    FirstError error(name);
    google::protobuf::TextFormat::Parser parser;
    parser.RecordErrorsTo(&error);
    schema::Scene message;
    if (!isUtf8(text)) throw Error(ErrorCode::Input, name + ": it is not UTF-8 text");
    if (!parser.ParseFromString(text, &message)) throw Error(ErrorCode::Input, error.text());
    const SceneChanges left = changeWritten(changes, message);
    try {
        Scene scene = resolveScene(message, directory, options);
        changeScene(left, scene);
        makeNamesReadable(scene);
        validate(scene);
        return scene;
    } catch (const Error& e) {
        if (e.code() == ErrorCode::Usage) throw;  // of changes, which are not in the file
        throw Error(e.code(), name + ": " + readableText(e.what()));
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::Input, name + ": the scene asks for more memory than there is");
    }
}

Scene loadScene(const std::string& path, const ImportOptions& options, const SceneChanges& changes) {
    const std::filesystem::path file(path);
    Scene scene;
    if (path == "-") {
        const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
        scene = parseScene(text, "standard input", ".", options, changes);
    } else if (file.extension() == ".textproto") {
        const std::vector<uint8_t> bytes = readFileBytes(path);
        scene = parseScene({bytes.begin(), bytes.end()}, path, file.parent_path().string(), options, changes);
        if (scene.name.empty()) scene.name = file.stem().string();
    } else {
        scene = importModel(path, options, [&](Scene& imported) { changeImported(changes, imported, path); });
    }
    for (std::string& notice : precisionNotices(scene)) scene.notices.push_back(std::move(notice));
    return scene;
}

}  // namespace antipode
