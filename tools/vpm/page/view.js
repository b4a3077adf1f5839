// Pictures on a canvas, zoomed and moved alike: one, two side by side, or two divided by a line.
'use strict';

const kLargestZoom = 64;

/** What is seen of the pictures: the point in the middle, in pixels, and how much larger than whole (zoom 1). */
const wholeView = pictures => ({x: pictures.width / 2, y: pictures.height / 2, zoom: 1});

/** Screen pixels that a pixel takes in a pane. */
const magnification = (pane, pictures, view) =>
    Math.min(pane.width / pictures.width, pane.height / pictures.height) * view.zoom;

/** Where in the pictures a point of a pane is, in pixels. */
function picturePoint(pane, pictures, view, x, y) {
  const scale = magnification(pane, pictures, view);
  return {x: view.x + (x - pane.left - pane.width / 2) / scale, y: view.y + (y - pane.top - pane.height / 2) / scale};
}

/** The pixel at such a point; nothing outside. */
function pixelAt(pictures, {x, y}) {
  const [column, row] = [Math.floor(x), Math.floor(y)];
  const inside = column >= 0 && row >= 0 && column < pictures.width && row < pictures.height;
  return inside ? {x: column, y: row} : null;
}

/** The view with the middle inside the pictures and a zoom that makes sense. */
function bounded(view, pictures) {
  const within = (x, size) => Math.min(size, Math.max(0, x));
  const zoom = Math.min(kLargestZoom, Math.max(1, view.zoom));
  if (zoom === 1) return wholeView(pictures);
  return {x: within(view.x, pictures.width), y: within(view.y, pictures.height), zoom};
}

/** The view zoomed about a point of the pictures, which stays where it is. */
function zoomed(view, factor, point, pictures) {
  const zoom = Math.min(kLargestZoom, Math.max(1, view.zoom * factor)), ratio = view.zoom / zoom;
  return bounded({x: point.x + (view.x - point.x) * ratio, y: point.y + (view.y - point.y) * ratio, zoom}, pictures);
}

/** Draws a painted picture into a pane: of it, what `clip` shows. */
function drawPane(context, {pane, clip, painting, label, labelRight}, pictures, view, marked) {
  const scale = magnification(pane, pictures, view);
  const left = pane.left + pane.width / 2 - view.x * scale, top = pane.top + pane.height / 2 - view.y * scale;
  context.save();
  context.beginPath();
  context.rect(clip.left, clip.top, clip.width, clip.height);
  context.clip();
  context.imageSmoothingEnabled = scale < 1;
  context.drawImage(painting, left, top, pictures.width * scale, pictures.height * scale);
  if (marked) drawMark(context, left + marked.x * scale, top + marked.y * scale, scale);
  if (label) drawLabel(context, clip, label, labelRight);
  context.restore();
}

/** A frame around a pixel, to be seen on bright and on dark. */
function drawMark(context, left, top, scale) {
  for (const [colour, grow] of [['black', 2.5], ['white', 1.5]]) {
    context.strokeStyle = colour;
    context.lineWidth = 1;
    context.strokeRect(left - grow, top - grow, scale + 2 * grow, scale + 2 * grow);
  }
}

function drawLabel(context, clip, text, atRight) {
  context.font = '13px system-ui, sans-serif';
  const width = context.measureText(text).width + 12, left = atRight ? clip.left + clip.width - width : clip.left;
  context.fillStyle = 'rgba(0, 0, 0, 0.65)';
  context.fillRect(left, clip.top, width, 22);
  context.fillStyle = 'white';
  context.fillText(text, left + 6, clip.top + 15);
}

/** Makes a canvas that many CSS pixels large; its context draws in these. */
function sizedContext(canvas, width, height) {
  const density = Math.max(1, window.devicePixelRatio);
  canvas.width = Math.round(width * density);
  canvas.height = Math.round(height * density);
  canvas.style.height = `${height}px`;
  const context = canvas.getContext('2d');
  context.scale(density, density);
  return context;
}
