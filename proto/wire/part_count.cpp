#include "proto/wire/part_count.h"

#include <google/protobuf/io/coded_stream.h>

namespace antipode::wire {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

class Counter {
public:
    Counter(std::string_view bytes, size_t limit)
        : input_(reinterpret_cast<const uint8_t*>(bytes.data()), int(bytes.size())), limit_(limit) {}

    /// Walks the fields of one message, up to the input's current limit.
    void walk(const Descriptor& type) {
        while (parts_ <= limit_) {
            const uint32_t tag = input_.ReadTag();
            if (tag == 0 || !readField(type.FindFieldByNumber(int(tag >> 3)), tag & 7)) return;
        }
    }

    size_t parts() const { return parts_; }

private:
    /// Reads what follows a tag. False at the end of what can be read.
    bool readField(const FieldDescriptor* field, uint32_t wireType) {
        const bool isMessage = field && field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
        const bool isString = field && field->cpp_type() == FieldDescriptor::CPPTYPE_STRING;
        if (!field || isMessage || (isString && field->is_repeated())) ++parts_;
        uint64_t ignored = 0;
        int size = 0;
        switch (wireType) {
            case 0: return input_.ReadVarint64(&ignored);
            case 1: return input_.Skip(8);
            case 2:
                if (!input_.ReadVarintSizeAsInt(&size)) return false;
                if (!isMessage) return input_.Skip(size);
                walkWithin(*field->message_type(), size);
                return true;
            case 5: return input_.Skip(4);
        }
        parts_ = limit_ + 1;  // groups: this syntax has none
        return false;
    }

    void walkWithin(const Descriptor& type, int size) {
        const auto outer = input_.PushLimit(size);
        walk(type);
        input_.Skip(input_.BytesUntilLimit());
        input_.PopLimit(outer);
    }

    google::protobuf::io::CodedInputStream input_;
    size_t parts_ = 0, limit_;
};

}  // namespace

size_t partCount(std::string_view bytes, const Descriptor& type, size_t limit) {
    Counter counter(bytes, limit);
    counter.walk(type);
    return counter.parts();
}

}  // namespace antipode::wire
