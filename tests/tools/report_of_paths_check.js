// The examination of the page of one pass of the path tracer, which tells no error, emits no photons, and has no parts.
'use strict';

examine(() => {
  expect(encoded.pictures.length === 1 && viewer.find('.modes').hidden, 'there is a choice of one picture');
  expect(find('facts').textContent.includes('not stated'), `an error is stated: ${find('facts').textContent}`);
  expect(find('energy').textContent.includes('No photons were emitted'), 'there is an energy ledger');
  expect(find('techniques').textContent === '' && find('warnings').textContent === '', 'an empty part is shown');
  expect(find('time').querySelectorAll('.bar span').length >= 1, 'no time is shown');
});
