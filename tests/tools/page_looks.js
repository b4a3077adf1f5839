// How the page looks: contrasts of its texts, what is left of it on paper.
'use strict';

/** Of "rgb(...)" or "rgba(...)": three bytes, and how opaque it is. */
function parsedColour(text) {
  const [r, g, b, opacity = 1] = text.match(/[\d.]+/g).map(Number);
  return {bytes: [r, g, b], opacity};
}

/** The colour behind a text. */
function groundOf(node) {
  const ground = parsedColour(getComputedStyle(node).backgroundColor);
  return ground.opacity === 1 ? ground : groundOf(node.parentElement);
}

/** [Kirkpatrick2018, sec. 1.4.3]: (L1 + 0.05) / (L2 + 0.05) of the luminances of text and ground. */
function contrastOf(node) {
  const linear = byte => (byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = ({bytes: [r, g, b]}) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const [least, most] =
      [parsedColour(getComputedStyle(node).color), groundOf(node)].map(luminance).sort((x, y) => x - y);
  return (most + 0.05) / (least + 0.05);
}

const isVisible = node => node.checkVisibility();
const hasText = node => [...node.childNodes].some(child => child.nodeType === Node.TEXT_NODE && child.data.trim());

/** No text is harder to read than the guidelines allow, and there are texts of these kinds. */
function checkContrast(where, kinds) {
  const texts = [...document.querySelectorAll('body *')].filter(node => hasText(node) && isVisible(node));
  for (const kind of kinds) expect(texts.some(node => node.matches(kind)), `no text in ${kind} ${where}`);
  const contrasts = texts.map(contrastOf), least = Math.min(...contrasts), worst = texts[contrasts.indexOf(least)];
  expect(least >= 4.5, `contrast ${least} ${where}: ${worst.localName}, "${worst.textContent.slice(0, 40)}"`);
}

/** By the rules for paper, as wide as A4 with margins. */
function layOnPaper() {
  for (const rule of document.styleSheets[0].cssRules)
    if (rule instanceof CSSMediaRule) rule.media.mediaText = rule.media.mediaText === 'print' ? 'all' : 'not all';
  document.body.style.width = '19cm';
}

/** A button that is left looks like a text. */
function looksLikeText(button) {
  const {backgroundColor, borderTopWidth, borderTopColor, boxShadow} = getComputedStyle(button);
  const isClear = colour => parsedColour(colour).opacity === 0;
  return isClear(backgroundColor) && (borderTopWidth === '0px' || isClear(borderTopColor)) && boxShadow === 'none';
}

/**
 * On paper there is nothing to use, all plots and pictures are there, no table is cut, and texts are of these kinds.
 */
function checkPaper(kinds) {
  checkContrast('on paper', kinds);
  const controls = [...document.querySelectorAll('select, input, nav, .controls, .modes, .keys, #save-results')];
  expect(!controls.some(isVisible), `on paper: ${controls.filter(isVisible).map(node => node.outerHTML.slice(0, 60))}`);
  const buttons = [...document.querySelectorAll('button')].filter(isVisible);
  expect(buttons.every(looksLikeText), 'a button looks like one on paper');
  const {left, right} = document.body.getBoundingClientRect();
  for (const canvas of document.querySelectorAll('canvas:not(.swatch)')) {
    const box = canvas.getBoundingClientRect(), ratio = canvas.width / canvas.height;
    expect(
        isVisible(canvas) && box.height > 60 && box.left >= left - 1 && box.right <= right + 1 &&
            near(box.width / box.height, ratio, 0.02),
        `a picture of ${canvas.width} x ${canvas.height} is ${box.width} x ${box.height} on paper`);
  }
  for (const {scrollWidth, clientWidth, ariaLabel} of document.querySelectorAll('.scroll'))
    expect(scrollWidth <= clientWidth, `${ariaLabel}: ${scrollWidth} pixels on ${clientWidth} of paper`);
}
