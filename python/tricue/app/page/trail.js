// SPDX-License-Identifier: MIT
// The trail: where a box's center was in the last seconds, fading, broken where the target was lost.

const SECONDS = 2;

/** Draw a target's trail up to a frame; place(x, y) gives the screen's pixels of the frame's. */
export function drawTrail(pen, model, id, frame, place) {
  const now = model.seconds(frame);
  const parts = [];
  let before = null;
  for (const at of model.framesUpTo(frame, now - SECONDS)) {
    const box = model.known(id, at) ? model.box(id, at) : null;
    const point = box && place(box[0] + box[2] / 2, box[1] + box[3] / 2);
    if (point && before) parts.push([before, point, 1 - (now - model.seconds(at)) / SECONDS]);
    before = point;
  }
  pen.lineCap = "round";
  for (const [ink, width] of [["#000000", 4.5], [model.color(id), 2.5]]) {
    pen.strokeStyle = ink;
    pen.lineWidth = width;
    for (const [from, to, strength] of parts) {
      pen.globalAlpha = strength * (ink === "#000000" ? 0.4 : 1);
      pen.beginPath();
      pen.moveTo(...from);
      pen.lineTo(...to);
      pen.stroke();
    }
  }
  pen.globalAlpha = 1;
  pen.lineCap = "butt";
}
