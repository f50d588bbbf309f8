// The XML of a Collada file, read beside Assimp 5.2 for what that invents or misreads.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "renderengine/vec.h"

namespace antipode {

struct ColladaSpot {
    double outerHalfAngle, innerHalfAngle;  ///< radians
};

struct ColladaLens {
    double verticalFov;             ///< radians
    double aspect;                  ///< width over height; 0 where the file does not tell
    double orthographicHeight = 0;  ///< of a parallel projection what the image's height shows
};

/// What an effect says of its highlight; a <lambert> or <constant> has none, whatever Assimp fills in.
struct ColladaHighlight {
    Vec3f specular;
    float exponent = 0;
};

class ColladaDocument {
public:
    /// Throws Error(Input), without the path, where the file is not well-formed XML.
    explicit ColladaDocument(const std::string& path);
    ~ColladaDocument();
    ColladaDocument(const ColladaDocument&) = delete;
    ColladaDocument& operator=(const ColladaDocument&) = delete;

    /// The file for Assimp, which takes a space before a colour for an error.
    const std::string& text() const { return text_; }

    /// The light or camera that hangs on the node which Assimp calls so. Nothing for other lights than spots.
    /// Blender writes the full angle of a cone and its soft part in an <extra>; others the half angle.
    std::optional<ColladaSpot> spot(const std::string& node) const;
    std::optional<ColladaLens> lens(const std::string& node) const;
    /// Of the effect behind the material of this name.
    std::optional<ColladaHighlight> highlight(const std::string& material) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
    std::string text_;
};

}  // namespace antipode
