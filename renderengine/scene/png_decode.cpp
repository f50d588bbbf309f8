#include "scene/png_decode.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>

#include "scene/image_size.h"

namespace antipode {
namespace {

/// libpng reports errors by longjmp, which must not skip destructors: the functions that call setjmp own nothing.
/// libpng's simplified interface is no way out: version 1.6.39 misreads interlaced pictures of 16 bits, and refuses to
/// tell a missing half from a colour profile that it does not like.
class PngReader {
public:
    explicit PngReader(std::span<const uint8_t> data) : rest_(data) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
        if (png_) info_ = png_create_info_struct(png_);
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    /// False after an error, which message() tells; so, too, below.
    bool readHeader() {
        if (!info_) return false;
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_read_fn(png_, this, onRead);
        png_read_info(png_, info_);
        png_set_expand(png_);
        png_set_strip_16(png_);
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
        passes_ = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    /// `rgba`: height() rows of rowBytes().
    bool readPixels(uint8_t* rgba) {
        if (setjmp(png_jmpbuf(png_))) return false;
        for (int pass = 0; pass < passes_; ++pass)
            for (uint32_t y = 0; y < height(); ++y) png_read_row(png_, rgba + y * rowBytes(), nullptr);
        png_read_end(png_, nullptr);
        return true;
    }

    uint32_t width() const { return png_get_image_width(png_, info_); }
    uint32_t height() const { return png_get_image_height(png_, info_); }
    size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
    const std::string& message() const { return message_; }

private:
    [[noreturn]] static void onError(png_structp png, png_const_charp message) {
        static_cast<PngReader*>(png_get_error_ptr(png))->message_ = message;
        png_longjmp(png, 1);
    }
    static void onWarning(png_structp, png_const_charp) {}
    static void onRead(png_structp png, png_bytep out, size_t size) {
        auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (size > reader.rest_.size()) png_error(png, "it is cut short");
        std::copy_n(reader.rest_.begin(), size, out);
        reader.rest_ = reader.rest_.subspan(size);
    }

    std::span<const uint8_t> rest_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    int passes_ = 0;
    std::string message_ = "libpng has no memory";
};

}  // namespace

Texture decodePng(std::span<const uint8_t> data, const std::string& name) {
    PngReader reader(data);
    if (!reader.readHeader()) failToDecode(name, reader.message());
    Texture texture = allocateTexture(name, reader.width(), reader.height(), data.size());
    if (reader.rowBytes() != size_t(texture.width) * 4) failToDecode(name, "it does not become RGBA");
    if (!reader.readPixels(texture.rgba.data())) failToDecode(name, reader.message());
    return texture;
}

}  // namespace antipode
