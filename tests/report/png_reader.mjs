// Reads the PNG files that png_writer.cpp wrote (8-bit RGB, rows without filter): the truth for the pixel values.
import { readFileSync } from 'node:fs';
import { inflateSync } from 'node:zlib';

export const readPng = (file) => {
  const bytes = readFileSync(file);
  const width = bytes.readUInt32BE(16), height = bytes.readUInt32BE(20);
  const parts = [];
  for (let at = 8; at < bytes.length;) {
    const length = bytes.readUInt32BE(at);
    if (bytes.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(bytes.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  const rows = inflateSync(Buffer.concat(parts));
  return { width, height, code: (x, y) => [0, 1, 2].map((c) => rows[y * (3 * width + 1) + 1 + 3 * x + c]) };
};

export const linear = (code) => {
  const v = code / 255;
  return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
};
