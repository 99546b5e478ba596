#include <webp/encode.h>
#include <webp/mux.h>

#include <memory>

#include "webp.hpp"

namespace sillon::cli {
namespace {

struct Writer : WebPMemoryWriter {
  Writer() : WebPMemoryWriter{} { WebPMemoryWriterInit(this); }
  ~Writer() { WebPMemoryWriterClear(this); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

struct Picture : WebPPicture {
  Picture() : WebPPicture{} { WebPPictureInit(this); }
  ~Picture() { WebPPictureFree(this); }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
};

struct Assembled : WebPData {
  Assembled() : WebPData{} { WebPDataInit(this); }
  ~Assembled() { WebPDataClear(this); }
  Assembled(const Assembled&) = delete;
  Assembled& operator=(const Assembled&) = delete;
};

struct MuxDelete {
  void operator()(WebPMux* mux) const { WebPMuxDelete(mux); }
};

Error outOfMemory() { return {ErrorCode::TooLarge, "a moving picture needs more memory than there is"}; }

/// Encodes a frame as a file of its own. \return false if memory ran out.
bool encode(const RgbImage& image, const WebPConfig& config, Writer& writer) {
  Picture picture;
  picture.width = image.width;
  picture.height = image.height;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  return WebPPictureImportRGB(&picture, image.rgb.data(), image.width * 3) != 0 && WebPEncode(&config, &picture) != 0;
}

}  // namespace

bool writesWebp() { return true; }

Result<std::string> encodeWebp(const std::vector<WebpFrame>& frames, int quality, const RunContext& run) {
  WebPConfig config;
  if (WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)) == 0) {
    return Error{ErrorCode::Internal, "libwebp is of another version than its headers"};
  }
  config.thread_level = 0;
  const std::unique_ptr<WebPMux, MuxDelete> mux(WebPMuxNew());
  if (mux == nullptr) return outOfMemory();
  for (const WebpFrame& frame : frames) {
    if (run.cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    Writer writer;
    if (!encode(frame.picture, config, writer)) return outOfMemory();
    WebPMuxFrameInfo info{};
    info.bitstream = {writer.mem, writer.size};
    info.duration = frame.milliseconds;
    info.id = WEBP_CHUNK_ANMF;
    info.blend_method = WEBP_MUX_NO_BLEND;
    if (WebPMuxPushFrame(mux.get(), &info, 1) != WEBP_MUX_OK) return outOfMemory();
  }
  const WebPMuxAnimParams endless{0xff000000, 0};
  Assembled file;
  if (WebPMuxSetAnimationParams(mux.get(), &endless) != WEBP_MUX_OK ||
      WebPMuxAssemble(mux.get(), &file) != WEBP_MUX_OK) {
    return outOfMemory();
  }
  return std::string(reinterpret_cast<const char*>(file.bytes), file.size);
}

}  // namespace sillon::cli
