// The examination of the page of a crop, (3, 2) to (8, 5) of its film.
'use strict';

examine(() => {
  expect(find('facts').textContent.includes('of which (3, 2) to (8, 5) are rendered'), 'the crop is not told');
  const named = (block, pixel) => Object.assign(Object.create(viewer), {block}).nameOf(pixel);
  expect(named(1, {x: 1, y: 3}) === 'Pixel (4, 5)', named(1, {x: 1, y: 3}));
  expect(named(4, {x: 1, y: 0}) === 'Mean of the pixels (7 to 8, 2 to 5)', named(4, {x: 1, y: 0}));
});
