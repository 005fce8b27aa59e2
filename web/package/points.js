// Conversion of points to one array of x, z, x, z, ...

const accepted = 'pairs of numbers: [x, z, x, z, ...], [[x, z], ...] or [{x, z}, ...], metres';

function reject(what) {
  throw new Error(`${what}, expected ${accepted}`);
}

/** @returns {Float64Array} a copy, two numbers per point */
export function flatPoints(points) {
  const isList = Array.isArray(points) || (ArrayBuffer.isView(points) && !(points instanceof DataView));
  if (!isList) reject(`points is ${points === null || typeof points !== 'object' ? String(points) : 'an object'}`);
  const isFlat = typeof points[0] === 'number' || points.length === 0;
  if (isFlat) {
    if (points.length % 2 !== 0) reject(`points has ${points.length} numbers`);
    for (let i = 0; i < points.length; ++i)
      if (typeof points[i] !== 'number') reject(`points[${i}] is ${String(points[i])}`);
    return Float64Array.from(points);
  }
  const flat = new Float64Array(2 * points.length);
  points.forEach((point, i) => {
    const [x, z] = Array.isArray(point) ? point : [point?.x, point?.z];
    if (typeof x !== 'number' || typeof z !== 'number') reject(`points[${i}] is no pair of numbers`);
    flat[2 * i] = x;
    flat[2 * i + 1] = z;
  });
  return flat;
}
