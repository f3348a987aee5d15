// Frames as they come: header, picture, acknowledgement.

const types = {1: 'image/jpeg', 2: 'image/png'};

/** The header of a binary message, or null where it is none. */
export function readHeader(buffer) {
  const view = new DataView(buffer);
  if (buffer.byteLength < 32 || view.getUint32(0) !== 0x42564631) return null;  // BVF1
  const flags = view.getUint8(6);
  return {
    type: types[view.getUint8(4)],
    pane: view.getUint8(5),
    finished: (flags & 1) !== 0,
    moving: (flags & 2) !== 0,
    scale: view.getUint8(7),
    number: view.getUint32(8, true),
    frame: view.getUint32(12, true),
    width: view.getUint16(16, true),
    height: view.getUint16(18, true),
    passes: view.getUint32(20, true),
    spp: view.getFloat32(24, true),
    share: view.getFloat32(28, true),
  };
}

/** Decodes a binary message and acknowledges it once it was shown. One at a time, in order. */
export class FrameReader {
  constructor(connection, show) {
    this.connection = connection;
    this.show = show;
    this.last = Promise.resolve();
  }

  take(buffer) {
    const header = readHeader(buffer);
    if (!header) return;
    const picture = new Blob([new Uint8Array(buffer, 32)], {type: header.type});
    this.last = this.last.then(() => this.decode(header, picture));
  }

  async decode(header, picture) {
    try {
      // The bytes of the file, whatever the screen's profile is.
      const bitmap = await createImageBitmap(picture, {colorSpaceConversion: 'none'});
      this.show(header, bitmap);
      bitmap.close();
    } catch (error) {
      console.error('a frame could not be shown', error);  // the next one may be
    } finally {
      this.connection.send({type: 'ack', frame: header.frame});
    }
  }
}
