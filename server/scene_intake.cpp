#include "server/scene_intake.h"

#include <atomic>
#include <deque>
#include <exception>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "terminal/text.h"
#include "proto/scene_loader.h"
#include "proto/wire/frame.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"
#include "server/admission.h"
#include "server/blob_file.h"

namespace antipode {
namespace {

using farm::BlobRef;
using farm::Refusal;

constexpr int needsPerMessage = 1024;
/// How often blobs that did not become whole as asked for are asked for again: another upload of the same blob, a part
/// or a cached file that turns out damaged.
constexpr int repeats = 8;

/// What the background makes of a root or of a whole scene.
struct Product {
    std::atomic<bool> abandoned = false;
    std::exception_ptr failure;
    std::optional<BlobRef> lost;  // it was in the cache, but is gone or has other bytes
    bool lostIsWrong = false;     // other bytes
    std::shared_ptr<const farm::SceneRoot> root;
    JobSize size;
    uint64_t sceneBytes = 0;
    std::shared_ptr<const Scene> scene;
    std::string sceneHash;
};

/// Blobs that stay in the cache as long as this lives.
class Pins {
public:
    explicit Pins(SceneCache& cache) : cache_(cache) {}
    ~Pins() {
        for (const BlobRef& blob : blobs_) cache_.unpin(blob);
    }
    Pins(const Pins&) = delete;
    Pins& operator=(const Pins&) = delete;

    void add(const BlobRef& blob) {
        cache_.pin(blob);
        blobs_.push_back(blob);
    }
    const std::vector<BlobRef>& blobs() const { return blobs_; }

private:
    SceneCache& cache_;
    std::vector<BlobRef> blobs_;
};

void loadRoot(SceneCache& cache, const farm::OpenJob& job, Product& product) {
    const auto bytes = cache.find(job.scene(), &product.lostIsWrong);
    if (!bytes) product.lost = job.scene();
    if (!bytes) return;
    const auto root = std::make_shared<farm::SceneRoot>(wire::parseSceneRoot(*bytes));
    product.size = wire::jobSize(*root, job.settings());
    product.sceneBytes = wire::sceneBytes(*root);
    product.root = root;
}

void assemble(SceneCache& cache, Product& product) {
    const auto find = [&](const BlobRef& blob) {
        if (product.abandoned) throw Error(ErrorCode::Input, "The client has gone.");
        auto bytes = cache.find(blob, &product.lostIsWrong);
        if (bytes) return bytes;
        product.lost = blob;
        throw Error(ErrorCode::Input, "The blob " + blobKey(blob) + " is damaged in the server's cache.");
    };
    auto scene = std::make_shared<const Scene>(wire::assembleScene(*product.root, find));
    product.sceneHash = sceneHash(*scene);
    product.scene = std::move(scene);
}

}  // namespace

void runAtOnce(const std::function<void()>& work, const std::function<void()>& done) {
    work();
    done();
}

struct SceneIntake::Impl {
    Impl(SceneIntake& intake, SceneCache& cache, Background background, farm::OpenJob job, IntakeListener& listener)
        : intake_(intake),
          cache_(cache),
          background_(std::move(background)),
          job_(std::move(job)),
          listener_(listener),
          pins_(cache) {
        pins_.add(job_.scene());
    }
    ~Impl() {
        if (product_) product_->abandoned = true;
    }

    void refuse(Refusal::Code code, const std::string& sentence) { listener_.refused(refusal(code, sentence)); }

    // ---- Uploading

    /// Asks for what is missing of the blobs that are known so far, or goes on where nothing is.
    void advance() {
        farm::NeedBlobs needs;
        for (const BlobRef& blob : pins_.blobs()) {
            const uint64_t offset = cache_.available(blob);
            if (offset == blob.size()) continue;
            auto& need = *needs.add_need();
            *need.mutable_blob() = blob;
            need.set_offset(offset);
            if (needs.need_size() == needsPerMessage) break;
        }
        if (needs.need_size() == 0) return build();
        needed_.assign(needs.need().begin(), needs.need().end());
        beginBlob();
        listener_.need(needs);
    }

    void beginBlob() {
        if (needed_.empty()) return;
        next_ = needed_.front().offset();
        allOurs_ = next_ == 0;
    }

    void receive(const farm::BlobChunk& chunk, std::string_view bytes) {
        if (needed_.empty()) throw wire::ProtocolError("A blob's chunk came that was not asked for.");
        const BlobRef blob = needed_.front().blob();
        if (chunk.sha256() != blob.sha256() || chunk.offset() != next_)
            throw wire::ProtocolError("A blob's chunk came out of order.");
        if (bytes.empty() || bytes.size() > blob.size() - next_)
            throw wire::ProtocolError("A blob's chunk is empty or goes beyond its blob.");
        if (!keep(blob, bytes)) return;
        next_ += bytes.size();
        if (next_ < blob.size()) return;
        if (cache_.available(blob) != blob.size()) repeat_ = true;
        if (allOurs_)
            ours_.insert(blob.sha256());
        else
            ours_.erase(blob.sha256());
        needed_.pop_front();
        beginBlob();
        if (!needed_.empty()) return;
        if (!std::exchange(repeat_, false) || mayRepeat()) advance();
    }

    /// Appends what the cache does not have yet: another session may be uploading the same blob. False where the job is
    /// refused.
    bool keep(const BlobRef& blob, std::string_view bytes) {
        const uint64_t have = cache_.available(blob);
        if (have != next_) allOurs_ = false;
        // Behind: the part has gone, and the blob is asked for again. Ahead by all that came: nothing to do.
        if (have < next_ || have - next_ >= bytes.size()) return true;
        try {
            cache_.append(blob, have, bytes.substr(have - next_));
        } catch (const Error& error) {
            if (error.code() == ErrorCode::Input) return true;  // the part has just gone, and is asked for again
            const bool tooLarge = error.code() == ErrorCode::Usage;
            needed_.clear();
            refuse(tooLarge ? Refusal::TOO_LARGE : Refusal::BUSY, error.what());
            return false;
        }
        return true;
    }

    bool mayRepeat() {
        if (++repeated_ <= repeats) return true;
        refuse(Refusal::BUSY,
               "The scene's blobs do not arrive whole, because other clients upload the same ones or "
               "the server's disk is faulty: try again later.");
        return false;
    }

    // ---- Building

    /// The root, as soon as it is here; then the scene, as soon as all is here.
    void build() {
        if (!product_) product_ = std::make_shared<Product>();
        product_->lost.reset();
        product_->failure = nullptr;
        background_(
            [product = product_, &cache = cache_, job = job_] {
                if (product->abandoned) return;
                try {
                    if (product->root)
                        assemble(cache, *product);
                    else
                        loadRoot(cache, job, *product);
                } catch (...) {
                    product->failure = std::current_exception();
                }
            },
            [weak = intake_.weak_from_this()] {
                if (const auto intake = weak.lock()) intake->impl_->built();
            });
    }

    void built() {
        if (product_->lost) return fetchAgain(*product_->lost);
        try {
            if (product_->failure) std::rethrow_exception(product_->failure);
        } catch (const std::bad_alloc&) {
            return refuse(Refusal::TOO_LARGE, "The server has not enough memory for the scene.");
        } catch (const std::exception& error) {
            return refuse(Refusal::BAD_SCENE, error.what());
        }
        if (product_->scene)
            deliver();
        else
            takeRoot();
    }

    /// Wrong bytes are the client's fault where nobody else has had a hand in the blob.
    void fetchAgain(const BlobRef& lost) {
        if (product_->lostIsWrong && ours_.contains(lost.sha256()))
            return refuse(Refusal::BAD_SCENE,
                          "The blob " + blobKey(lost) + " does not have the hash that it was announced with.");
        if (mayRepeat()) advance();
    }

    void takeRoot() {
        if (const auto refused = listener_.admit(product_->size, product_->sceneBytes))
            return listener_.refused(*refused);
        for (const BlobRef& blob : wire::blobsOf(*product_->root)) pins_.add(blob);
        uint64_t bytes = 0;
        for (const BlobRef& blob : pins_.blobs()) bytes += blob.size();
        if (bytes > cache_.maxBytes())
            return refuse(Refusal::TOO_LARGE, "The scene's blobs have " + byteSize(bytes) +
                                                  "; the server's scene cache holds " + byteSize(cache_.maxBytes()) +
                                                  ".");
        advance();
    }

    void deliver() {
        if (product_->sceneHash != job_.scene_hash())
            return refuse(Refusal::BAD_SCENE,
                          "The scene does not have the hash that it was announced with: client and "
                          "server differ in how they read it.");
        listener_.assembled(product_->scene, product_->size, product_->sceneBytes);
    }

    SceneIntake& intake_;
    SceneCache& cache_;
    const Background background_;
    const farm::OpenJob job_;
    IntakeListener& listener_;
    Pins pins_;                                 // the root first
    std::deque<farm::NeedBlobs::Need> needed_;  // asked for and not complete
    uint64_t next_ = 0;                         // offset in the first of them
    bool allOurs_ = false;                      // so far, all of it came through here
    std::set<std::string> ours_;                // hashes of blobs that came here, from the first byte to the last
    bool repeat_ = false;                       // something has to be asked for again
    int repeated_ = 0;
    std::shared_ptr<Product> product_;
};

SceneIntake::SceneIntake(SceneCache& cache, Background background, farm::OpenJob job, IntakeListener& listener)
    : impl_(std::make_unique<Impl>(*this, cache, std::move(background), std::move(job), listener)) {}
SceneIntake::~SceneIntake() = default;

void SceneIntake::start() { impl_->advance(); }

void SceneIntake::receive(const farm::BlobChunk& chunk, std::string_view bytes) { impl_->receive(chunk, bytes); }

bool SceneIntake::expectsChunks() const { return !impl_->needed_.empty(); }

}  // namespace antipode
