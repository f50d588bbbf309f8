// What a film shows while it is being rendered: taken in bands, so that nobody waits for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderengine/film.h"

namespace antipode::view {

/// The light that one technique found.
struct TechniquePicture {
    LayerKind kind = LayerKind::EmitterHit;
    Image image;
};

/// Mean images of a film, of one size. Where the film has more than 2^22 pixels, each of theirs is the mean of
/// `reduction`² of the film's, or of what there is of these at the right and lower edges.
struct Picture {
    uint64_t iterations = 0;  ///< when its first band was taken
    uint32_t reduction = 1;
    Image image;
    std::vector<TechniquePicture> techniques;  ///< of those that the film has layers of
};

/// How many pixels of a film, along each side, become one.
uint32_t pictureReduction(uint32_t width, uint32_t height);

/// Takes pictures band by band between steps of the event loop that owns the film. Bands of one picture may differ by
/// the iterations that came meanwhile; each is a mean image.
class PictureTaker {
public:
    /// Whether a picture has been begun and is not complete.
    bool busy() const { return picture_.has_value(); }
    /// Goes on with the picture in hand, or begins one, for about so many seconds, but for a row at least; returns it
    /// when it is complete. The film must have iterations and stay of one layout.
    std::optional<Picture> take(const FilmSums& sums, double seconds);
    /// Forgets the picture in hand and takes one at once.
    Picture takeWhole(const FilmSums& sums);

private:
    void begin(const FilmSums& sums);
    void takeRow(const FilmSums& sums, uint32_t row);

    std::optional<Picture> picture_;
    uint32_t nextRow_ = 0;
};

/// A picture as the page is sent it.
struct EncodedPicture {
    uint32_t width = 0, height = 0, reduction = 1;
    uint64_t iterations = 0;
    double stops = 0;    ///< the exposure at which it can be looked at, see autoExposure()
    int exponent = 0;    ///< `halves` are radiance × 2^exponent, which brings what is seen into their range
    std::string halves;  ///< see encodeHalfRgb()
};

/// The sum of the techniques whose bits (1 << LayerKind) are set; the whole image where that is all of the picture's.
EncodedPicture encodePicture(const Picture& picture, uint32_t techniques = ~0u);

}  // namespace antipode::view
