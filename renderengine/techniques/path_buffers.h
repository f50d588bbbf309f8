// Device memory for the paths of one batch, for the film and for the counters.
#pragma once

#include "techniques/film_buffer.h"
#include "techniques/job.h"
#include "vulkan/bindings.h"

namespace antipode {

class PathBuffers {
public:
    /// `batchSize` paths travel together; interfaces: with the media that they are in.
    PathBuffers(Device& device, uint32_t batchSize, const Job& job, bool interfaces);

    void bind(BindingTable& table) const;
    uint32_t batchSize() const { return batchSize_; }
    const Buffer& counters() const { return counters_; }
    FilmBuffer& film() { return film_; }
    const FilmBuffer& film() const { return film_; }

private:
    uint32_t batchSize_;
    Buffer job_, paths_, hits_, radiance_, techniqueRadiance_, shadow_, queues_, counters_, slotFlags_, waveVertices_,
        media_;
    FilmBuffer film_;
};

}  // namespace antipode
